# weft_fabrics(TARGET): builds assets/fabrics/*.toml into TARGET, so that presets are found wherever
# the program is installed or run.
function(weft_fabrics TARGET)
    file(GLOB fabrics CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/assets/fabrics/*.toml)
    list(SORT fabrics)
    list(JOIN fabrics "|" joined)
    set(out ${CMAKE_CURRENT_BINARY_DIR}/fabric_presets.cpp)
    set(script ${PROJECT_SOURCE_DIR}/cmake/write_fabric_presets.cmake)
    add_custom_command(OUTPUT ${out}
        COMMAND ${CMAKE_COMMAND} -DOUT=${out} "-DFILES=${joined}" -P ${script}
        DEPENDS ${fabrics} ${script}
        COMMENT "Writing the fabric presets into the program" VERBATIM)
    target_sources(${TARGET} PRIVATE ${out})
endfunction()
