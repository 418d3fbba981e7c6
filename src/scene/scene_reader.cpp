#include "scene/scene_reader.h"

#include "base/atomic_file.h"
#include "scene/key.h"
#include "scene/parse_toml.h"
#include "scene/read_objects.h"
#include "scene/toml_keys.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>

namespace weft {
namespace {

/// What `[[contact.friction]]` may speak of.
struct ObjectNames {
    std::vector<std::string> movers;
    std::vector<std::string> obstacles;
};

template <typename T>
void append_names(const std::vector<T>& objects, std::vector<std::string>& names) {
    for (const T& object : objects) {
        names.push_back(object.name);
    }
}

ObjectNames names_of(const Scene& scene) {
    ObjectNames names;
    append_names(scene.cloths, names.movers);
    append_names(scene.solids, names.movers);
    append_names(scene.rigids, names.movers);
    append_names(scene.obstacles, names.obstacles);
    return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

void check_between(TomlTable& table, const FrictionPair& pair, const ObjectNames& objects) {
    std::vector<std::string> known = objects.movers;
    known.insert(known.end(), objects.obstacles.begin(), objects.obstacles.end());
    for (const std::string& name : pair.between) {
        if (!contains(known, name)) {
            table.fail("between", fmt::format("{} is no object; the nearest is {}", name,
                                              nearest_key(name, known)));
        }
    }
    if (!contains(objects.movers, pair.between[0]) && !contains(objects.movers, pair.between[1])) {
        table.fail("between", "must name one that moves: obstacles do not touch each other");
    }
}

bool same_objects(const FrictionPair& a, const FrictionPair& b) {
    return std::is_permutation(a.between.begin(), a.between.end(), b.between.begin());
}

ContactParams read_contact(TomlTable table, const ObjectNames& objects) {
    ContactParams params;
    read_keys(table, keys_of(params));
    for (TomlTable& entry : table.tables("friction")) {
        FrictionPair pair;
        read_keys(entry, keys_of(pair));
        check_between(entry, pair, objects);
        entry.finish();
        if (!entry.has("friction")) {
            entry.fail("needs friction");
        }
        entry.refuse(problem(pair));
        for (const FrictionPair& earlier : params.friction) {
            if (same_objects(earlier, pair)) {
                entry.fail("between", "must be unique: an earlier entry has the same two");
            }
        }
        params.friction.push_back(std::move(pair));
    }
    table.finish();
    return params;
}

/// Which points of the cloth a side names.
void check_points(TomlTable& table, const AttachSide& side, AttachKind kind) {
    const bool has_vertices = table.has("vertices");
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
}

AttachSide read_side(TomlTable table, AttachKind kind, const std::vector<std::string>& cloths) {
    AttachSide side;
    read_keys(table, keys_of(side, kind));
    table.finish();
    if (!table.has("cloth")) {
        table.fail("needs cloth");
    }
    if (!contains(cloths, side.cloth)) {
        table.fail("cloth", "must be the name of a cloth; the nearest is " +
                                nearest_key(side.cloth, cloths));
    }
    check_points(table, side, kind);
    return side;
}

AttachParams read_attach(TomlTable table, const std::vector<std::string>& cloths) {
    AttachParams params;
    read_keys(table, keys_of(params));
    check_name(table, params.name);
    const bool has_kind = table.has("kind");
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

SceneParams read_scene_params(TomlTable table) {
    SceneParams params;
    read_keys(table, keys_of(params));
    table.finish();
    table.refuse(problem(params));
    return params;
}

RenderParams read_render(TomlTable table) {
    RenderParams params;
    read_keys(table, keys_of(params));
    params.has_range = table.has("range");
    params.has_camera = table.has("camera");
    if (params.has_camera) {
        TomlTable camera = table.table("camera");
        if (!camera.has("eye") || !camera.has("target")) {
            camera.fail("needs eye and target");
        }
    }
    table.finish();
    table.refuse(problem(params));
    return params;
}

/// Names become file names: one for each object.
void require_unique_name(const TomlTable& table,
                         const std::string& name,
                         std::set<std::string>& taken) {
    if (!taken.insert(name).second) {
        table.fail("name", "must be unique: another one has it");
    }
}

void read_objects(TomlTable& root, Scene& scene) {
    std::set<std::string> taken;
    std::vector<std::string> leaders; ///< what pins may follow
    std::vector<std::string> cloth_names;
    for (const TomlTable& table : root.tables("obstacle")) {
        scene.obstacles.push_back(read_obstacle(table));
        leaders.push_back(scene.obstacles.back().name);
        require_unique_name(table, leaders.back(), taken);
    }
    for (const TomlTable& table : root.tables("rigid")) {
        scene.rigids.push_back(read_rigid(table));
        leaders.push_back(scene.rigids.back().name);
        require_unique_name(table, leaders.back(), taken);
    }
    for (const TomlTable& table : root.tables("cloth")) {
        scene.cloths.push_back(read_cloth(table, scene.base_dir, leaders));
        require_unique_name(table, scene.cloths.back().name, taken);
        cloth_names.push_back(scene.cloths.back().name);
    }
    for (const TomlTable& table : root.tables("solid")) {
        scene.solids.push_back(read_solid(table, leaders));
        require_unique_name(table, scene.solids.back().name, taken);
    }
    taken.clear(); // these name no files
    for (const TomlTable& table : root.tables("attach")) {
        scene.attachments.push_back(read_attach(table, cloth_names));
        require_unique_name(table, scene.attachments.back().name, taken);
    }
}

Scene read_tree(const toml::table& tree, const std::filesystem::path& base_dir) {
    TomlTable root(tree, "");
    Scene scene;
    scene.base_dir = base_dir;
    if (root.has("scene")) {
        scene.scene = read_scene_params(root.table("scene"));
    }
    read_objects(root, scene);
    if (root.has("contact")) {
        scene.contact = read_contact(root.table("contact"), names_of(scene));
    }
    if (root.has("render")) {
        scene.render = read_render(root.table("render"));
    }
    root.finish();
    if (scene.cloths.empty() && scene.solids.empty() && scene.rigids.empty()) {
        root.fail("needs a [[cloth]], [[solid]] or [[rigid]]: nothing would move");
    }
    return scene;
}

} // namespace

Scene read_scene_text(std::string_view text,
                      const std::string& place,
                      const std::filesystem::path& base_dir,
                      std::span<const std::string> sets) {
    toml::table tree = parse_toml(text, place);
    for (const std::string& set : sets) {
        apply_set(tree, set);
    }
    return read_tree(tree, base_dir);
}

Scene read_scene(const std::filesystem::path& file, std::span<const std::string> sets) {
    return read_scene_text(read_file(file), file.string(), file.parent_path(), sets);
}

} // namespace weft
