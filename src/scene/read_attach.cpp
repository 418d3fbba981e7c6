#include "scene/nearest_key.h"
#include "scene/read_parts.h"

#include <algorithm>

namespace weft {
namespace {

/// A vertex number, or a place [x, y, z].
void read_vertex(TomlTable& table, std::string_view key, std::optional<VertexChoice>& choice) {
    if (!table.has(key)) {
        return;
    }
    VertexChoice read;
    if (table.is_array(key)) {
        table.read(key, read.place);
    } else {
        table.read(key, read.vertex);
        if (read.vertex < 0) {
            table.fail(key, "must be >= 0, the index of a vertex, or a place [x, y, z]");
        }
    }
    choice = read;
}

void require_cloth(TomlTable& table,
                   std::string_view key,
                   const std::string& name,
                   const std::vector<std::string>& cloths) {
    if (std::find(cloths.begin(), cloths.end(), name) == cloths.end()) {
        table.fail(key, "must be the name of a cloth; the nearest is " + nearest_key(name, cloths));
    }
}

AttachSide read_side(TomlTable table, AttachKind kind, const std::vector<std::string>& cloths) {
    AttachSide side;
    const bool has_cloth = table.read("cloth", side.cloth);
    const bool has_vertices = table.read("vertices", side.vertices);
    if (kind == AttachKind::Seam) {
        read_vertex(table, "from", side.from);
        read_vertex(table, "to", side.to);
        read_vertex(table, "via", side.via);
    } else if (Vec3 at; table.read("at", at)) {
        side.at = at;
    }
    table.finish();
    if (!has_cloth) {
        table.fail("needs cloth");
    }
    require_cloth(table, "cloth", side.cloth, cloths);
    if (kind == AttachKind::Button) {
        if (has_vertices && side.at) {
            table.fail("has vertices and at: must be one of them");
        }
    } else if (has_vertices ? side.from || side.to || side.via : !side.from || !side.to) {
        table.fail("must have either vertices, or from and to");
    }
    if (has_vertices && side.vertices.size() < (kind == AttachKind::Seam ? 2 : 1)) {
        table.fail("vertices", kind == AttachKind::Seam ? "must name two vertices or more"
                                                        : "must name at least one vertex");
    }
    for (const Index v : side.vertices) {
        if (v < 0) {
            table.fail("vertices", "must be indices of vertices, >= 0");
        }
    }
    return side;
}

} // namespace

AttachParams read_attach(TomlTable table, const std::vector<std::string>& cloths) {
    AttachParams params;
    params.name = read_name(table);
    const bool has_kind = table.read_choice(
        "kind", params.kind, {{"seam", AttachKind::Seam}, {"button", AttachKind::Button}});
    table.read("start", params.start);
    table.read("close", params.close);
    table.read("until", params.until);
    table.read("strength", params.strength);
    table.read("radius", params.radius);
    table.read("weld", params.weld);
    const bool has_sides = table.has("a") && table.has("b");
    if (has_kind && has_sides) {
        params.a = read_side(table.table("a"), params.kind, cloths);
        params.b = read_side(table.table("b"), params.kind, cloths);
    }
    table.finish();
    table.refuse(problem(params));
    if (params.name.empty() || !has_kind || !has_sides) {
        table.fail(params.name.empty() ? "needs name"
                   : !has_kind         ? "needs kind: \"seam\" or \"button\""
                                       : "needs a and b, the sides");
    }
    if (params.kind == AttachKind::Button && params.a.vertices.empty() && !params.a.at) {
        table.fail("a", "must have vertices or at");
    }
    if (!params.b.vertices.empty() && params.kind == AttachKind::Button &&
        params.b.vertices.size() != (params.a.at ? 1 : params.a.vertices.size())) {
        table.fail("b", "must have as many vertices as a");
    }
    return params;
}

} // namespace weft
