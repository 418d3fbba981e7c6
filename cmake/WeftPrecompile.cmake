# Precompiled headers halve the time of a clean build, but ccache cannot store what was compiled with
# them: on where there is no ccache, as on a fresh machine.
if(WEFT_CCACHE)
    set(precompile OFF)
else()
    set(precompile ON)
endif()
option(WEFT_PRECOMPILE "Precompile the headers that most files include" ${precompile})

# weft_precompile(TARGET headers...): TARGET gets a precompiled header of its own of what most of our
# files include, and these headers. Others with the same flags share it: weft_precompile_as.
function(weft_precompile TARGET)
    if(WEFT_PRECOMPILE)
        target_precompile_headers(${TARGET} PRIVATE <Eigen/Dense> <fmt/core.h> <algorithm> <filesystem>
            <functional> <map> <memory> <optional> <span> <string> <vector> ${ARGN})
    endif()
endfunction()

function(weft_precompile_as OWNER TARGET)
    if(WEFT_PRECOMPILE AND NOT OWNER STREQUAL TARGET)
        target_precompile_headers(${TARGET} REUSE_FROM ${OWNER})
    endif()
endfunction()

# weft_compile_lightly(TARGET): for code that is large and never hot (the command line, the tests'
# own code), where optimising costs more time than it saves.
function(weft_compile_lightly TARGET)
    target_compile_options(${TARGET} PRIVATE -O1)
endfunction()

# weft_unite(TARGET): compiles the files of TARGET in groups, which is a third cheaper when all of them
# are compiled, and dearer when one was changed. So it goes with the precompiled headers.
option(WEFT_UNITY "Compile the files of a room in groups" ${WEFT_PRECOMPILE})
function(weft_unite TARGET)
    set_target_properties(${TARGET} PROPERTIES
        UNITY_BUILD ${WEFT_UNITY} UNITY_BUILD_BATCH_SIZE 6)
endfunction()
