#include "scene/fabric.h"
#include "scene/nearest_key.h"
#include "scene/read_parts.h"

#include <fmt/core.h>

namespace weft {
namespace {

/// A preset's name, or the path of a .toml file, as the user wrote it under `key`.
FabricParams
named_fabric(TomlTable& table, std::string_view key, const std::filesystem::path& base_dir) {
    std::string name;
    table.read(key, name);
    if (name.ends_with(".toml")) {
        const std::filesystem::path file = base_dir / name;
        if (!std::filesystem::is_regular_file(file)) {
            table.fail(key, fmt::format("there is no file {}", file.string()));
        }
        return read_fabric_file(file);
    }
    if (const Fabric* preset = find_fabric(name)) {
        return preset->params;
    }
    const std::vector<std::string> names = fabric_names();
    table.fail(key, fmt::format("must be a preset (weft fabric list) or a .toml file; the nearest "
                                "preset is {}",
                                nearest_key(name, names)));
}

} // namespace

void read_fabric_values(TomlTable& table, FabricParams& fabric) {
    if (table.read("name", fabric.name) && fabric.name.empty()) {
        table.fail("name", "must not be empty");
    }
    table.read("density", fabric.area_density);
    table.read("stretch", fabric.stretch_stiffness);
    table.read("shear", fabric.shear_stiffness);
    table.read("poisson", fabric.poisson);
    table.read("bend", fabric.bend_stiffness);
    table.read("thickness", fabric.thickness);
    read_friction(table, fabric.friction, fabric.static_friction);
    table.read("damping", fabric.damping);
    table.read("range", fabric.working_range);
    table.finish();
    table.refuse(problem(fabric));
}

void read_fabric(TomlTable& cloth, const std::filesystem::path& base_dir, FabricParams& fabric) {
    if (!cloth.has("fabric")) {
        return;
    }
    if (cloth.is_string("fabric")) {
        fabric = named_fabric(cloth, "fabric", base_dir);
        return;
    }
    if (!cloth.is_table("fabric")) {
        cloth.fail("fabric", "must be the name of a preset, a .toml file, or a table");
    }
    TomlTable table = cloth.table("fabric");
    if (table.has("base")) {
        fabric = named_fabric(table, "base", base_dir);
        fabric.name += ", altered";
    }
    read_fabric_values(table, fabric);
}

} // namespace weft
