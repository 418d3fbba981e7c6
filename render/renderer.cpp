#include "render/renderer.h"

#include "base/error.h"
#include "render/legend.h"
#include "render/problem_marks.h"

#include <fmt/core.h>

#include <string>

namespace weft {

namespace {

ColourScale make_scale(const RenderParams& params, int quantity, const Vec2& range) {
    const ColourMap* map = find_colour_map(params.map);
    if (map == nullptr) {
        std::string names;
        for (const ColourMap& known : colour_maps()) {
            names += (names.empty() ? "" : ", ") + std::string(known.name);
        }
        fail_input("render.map = \"{}\": must be one of {}", params.map, names);
    }
    const Vec2 used = params.has_range ? params.range : range;
    if (!(used[0] < used[1]) || !used.allFinite()) {
        fail_input("render.range = [{}, {}]: must be two finite values, the lower first", used[0],
                   used[1]);
    }
    return {map, used[0], used[1], k_quantities[static_cast<std::size_t>(quantity)].neutral};
}

int known_quantity(const std::string& name) {
    const int quantity = find_quantity(name);
    if (quantity < 0) {
        std::string names;
        for (const Quantity& known : k_quantities) {
            names += (names.empty() ? "" : ", ") + std::string(known.name);
        }
        fail_input("render.quantity = \"{}\": must be one of {}", name, names);
    }
    return quantity;
}

} // namespace

Renderer::Renderer(const RenderParams& params, const Extent& motion, const Vec2& range)
    : params_(params), bounds_(motion.box()), quantity_(known_quantity(params.quantity)),
      scale_(make_scale(params, quantity_, range)),
      camera_(place_camera(params.has_camera ? params.camera : frame_camera(motion, params.size),
                           params.size,
                           bounds_)),
      painter_(std::make_unique<Painter>(PainterParams{.size = params.size,
                                                       .supersample = params.supersample,
                                                       .edges = params.edges,
                                                       .scale = scale_,
                                                       .camera = camera_})) {}

Image Renderer::draw(const Frame& frame, PictureStats* stats) {
    const Stage stage = build_stage(frame, quantity_, bounds_, camera_.eye);
    ValuePicture values;
    Image image = painter_->paint(stage, stats == nullptr ? nullptr : &values);
    if (params_.problems) {
        draw_problem_marks(image, camera_, frame.problems);
    }
    if (params_.legend) {
        LegendContent content = describe_frame(frame, quantity_, scale_);
        if (params_.problems) {
            content.moment_notes.push_back(
                fmt::format("unresolved pairs  {}", frame.problems.size()));
        }
        draw_legend(image, content);
    }
    if (stats != nullptr) {
        *stats = count_values(values, scale_);
        stats->mean_colour = mean_colour(image);
    }
    return image;
}

} // namespace weft
