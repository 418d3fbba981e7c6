# cmake -DOUT=file.cpp -DFILES=a.toml|b.toml -P write_fabric_presets.cmake
# Writes the definition of fabric_preset_texts(): each file as a raw string literal.
string(REPLACE "|" ";" files "${FILES}")
set(entries "")
foreach(file IN LISTS files)
    get_filename_component(name "${file}" NAME_WE)
    file(READ "${file}" text)
    string(APPEND entries "    {\"${name}\", R\"TOML(${text})TOML\"},\n")
endforeach()
file(WRITE "${OUT}" "#include \"scene/fabric.h\"

namespace weft {
namespace {

constexpr FabricPresetText k_presets[] = {
${entries}};

} // namespace

std::span<const FabricPresetText> fabric_preset_texts() {
    return k_presets;
}

} // namespace weft
")
