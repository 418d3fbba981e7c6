#include "scene/fabric.h"

#include "base/atomic_file.h"
#include "scene/parse_toml.h"
#include "scene/read_objects.h"

#include <algorithm>

namespace weft {
namespace {

Fabric read_fabric_text(std::string_view text, const std::string& place, const std::string& name) {
    const toml::table root = parse_toml(text, place);
    TomlTable table(root, "");
    Fabric fabric{name, "", {}, text};
    table.read("description", fabric.description);
    fabric.params.name = name;
    read_fabric_values(table, fabric.params);
    return fabric;
}

} // namespace

const std::vector<Fabric>& fabric_library() {
    static const std::vector<Fabric> library = [] {
        std::vector<Fabric> fabrics;
        for (const FabricPresetText& preset : fabric_preset_texts()) {
            const std::string name(preset.name);
            fabrics.push_back(read_fabric_text(preset.toml, name + ".toml", name));
        }
        return fabrics;
    }();
    return library;
}

std::vector<std::string> fabric_names() {
    std::vector<std::string> names;
    for (const Fabric& fabric : fabric_library()) {
        names.push_back(fabric.name);
    }
    return names;
}

const Fabric* find_fabric(std::string_view name) {
    const auto& library = fabric_library();
    const auto found = std::find_if(library.begin(), library.end(),
                                    [&](const Fabric& fabric) { return fabric.name == name; });
    return found == library.end() ? nullptr : &*found;
}

FabricParams read_fabric_file(const std::filesystem::path& file) {
    const std::string text = read_file(file);
    return read_fabric_text(text, file.string(), file.stem().string()).params;
}

} // namespace weft
