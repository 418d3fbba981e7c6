#include "scene/scene_reader.h"

#include "base/atomic_file.h"
#include "scene/parse_toml.h"
#include "scene/read_parts.h"

#include <set>

namespace weft {
namespace {

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

template <typename T> std::vector<std::string> names_of(const std::vector<T>& objects) {
    std::vector<std::string> names;
    for (const T& object : objects) {
        names.push_back(object.name);
    }
    return names;
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
        std::vector<std::string> movers = names_of(scene.cloths);
        const std::vector<std::string> solids = names_of(scene.solids);
        movers.insert(movers.end(), solids.begin(), solids.end());
        const std::vector<std::string> rigids = names_of(scene.rigids);
        movers.insert(movers.end(), rigids.begin(), rigids.end());
        scene.contact = read_contact(root.table("contact"), movers, names_of(scene.obstacles));
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
