#include "scene/names.h"
#include "scene/read_parts.h"

namespace weft {
namespace {

template <std::size_t N>
std::vector<std::pair<std::string, std::string>>
choices_of(const std::array<std::string_view, N>& names) {
    std::vector<std::pair<std::string, std::string>> choices;
    for (const std::string_view name : names) {
        choices.emplace_back(name, name);
    }
    return choices;
}

void read_camera(TomlTable& render, RenderParams& params) {
    params.has_camera = render.has("camera");
    if (!params.has_camera) {
        return;
    }
    TomlTable camera = render.table("camera");
    const bool has_eye = camera.read("eye", params.camera.eye);
    const bool has_target = camera.read("target", params.camera.target);
    camera.read("fov_deg", params.camera.fov_deg);
    camera.finish();
    if (!has_eye || !has_target) {
        camera.fail("needs eye and target");
    }
}

} // namespace

RenderParams read_render(TomlTable table) {
    RenderParams params;
    table.read("size", params.size);
    table.read_choice<std::string>("quantity", params.quantity, choices_of(k_quantity_names));
    table.read_choice<std::string>("map", params.map, choices_of(k_map_names));
    params.has_range = table.read("range", params.range);
    table.read("edges", params.edges);
    table.read("legend", params.legend);
    table.read("problems", params.problems);
    read_camera(table, params);
    table.read("supersample", params.supersample);
    table.read("enabled", params.enabled);
    table.finish();
    table.refuse(problem(params));
    return params;
}

} // namespace weft
