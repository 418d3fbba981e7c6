#include "scene/object_choice.h"

#include "base/error.h"
#include "scene/nearest_key.h"

#include <algorithm>

namespace weft {

namespace {

bool is_called(const FileObject& object, const std::string& wanted) {
    return object.name == wanted || object.mesh_name == wanted ||
           std::find(object.parents.begin(), object.parents.end(), wanted) != object.parents.end();
}

void add_once(std::vector<std::string>& names, const std::string& name) {
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) {
        names.push_back(name);
    }
}

std::vector<std::string> object_names(const MeshFile& file) {
    std::vector<std::string> names;
    for (const FileObject& object : file.objects) {
        add_once(names, object.name);
    }
    return names;
}

std::vector<std::string> all_names(const MeshFile& file) {
    std::vector<std::string> names = object_names(file);
    for (const FileObject& object : file.objects) {
        add_once(names, object.mesh_name);
        for (const std::string& parent : object.parents) {
            add_once(names, parent);
        }
    }
    return names;
}

/// "Box", "Sphere" and 3 more
std::string list_names(const std::vector<std::string>& names) {
    constexpr std::size_t k_listed = 8;
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), k_listed); ++i) {
        text += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", names[i]);
    }
    return names.size() > k_listed ? fmt::format("{} and {} more", text, names.size() - k_listed)
                                   : text;
}

} // namespace

std::vector<std::size_t>
choose_objects(const MeshFile& file, std::span<const std::string> wanted, const std::string& name) {
    for (const std::string& w : wanted) {
        const bool found = std::any_of(file.objects.begin(), file.objects.end(),
                                       [&](const FileObject& o) { return is_called(o, w); });
        if (!found) {
            fail_input("{}: object = \"{}\": not in the file; nearest is \"{}\" (it has {})", name,
                       w, nearest_key(w, all_names(file)), list_names(object_names(file)));
        }
    }
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < file.objects.size(); ++i) {
        const bool is_wanted =
            wanted.empty() || std::any_of(wanted.begin(), wanted.end(), [&](const std::string& w) {
                return is_called(file.objects[i], w);
            });
        if (is_wanted) {
            chosen.push_back(i);
        }
    }
    return chosen;
}

} // namespace weft
