#include "scene/object_name.h"
#include "scene/read_parts.h"

namespace weft {
namespace {

void read_units(TomlTable& table, MeshSource& source) {
    source.units_given = table.has("units");
    if (!table.is_string("units")) {
        table.read("units", source.metres_per_unit);
        return;
    }
    table.read_choice<double>("units", source.metres_per_unit,
                              {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}});
}

} // namespace

std::string read_name(TomlTable& table) {
    std::string name;
    if (!table.read("name", name)) {
        return name;
    }
    if (!is_object_name(name)) {
        table.fail("name", "must be letters, digits, '_' or '-', at most 64: it names files");
    }
    return name;
}

void read_mesh_source(TomlTable& table, MeshSource& source, std::string_view key) {
    if (table.read(key, source.file) && source.file.empty()) {
        table.fail(key, "must be the path of a mesh file");
    }
    table.read("object", source.objects);
    read_units(table, source);
    source.up_given = table.read_choice<char>("up", source.up, {{"y", 'y'}, {"z", 'z'}});
    table.read("repair", source.repair);
    table.refuse(problem(source));
    for (const char* other : {"object", "units", "up", "repair"}) {
        if (source.file.empty() && table.has(other)) {
            table.fail(other, "needs mesh, whose file it describes");
        }
    }
}

void read_placement(TomlTable& table, Placement& placement) {
    table.read("translate", placement.translate);
    table.read("rotate_deg", placement.rotate_deg);
    table.read("scale", placement.scale);
    table.refuse(problem(placement));
}

} // namespace weft
