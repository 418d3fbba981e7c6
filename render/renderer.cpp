#include "render/renderer.h"

#include "base/error.h"
#include "render/drawn_scene.h"
#include "render/legend.h"

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

PictureStats count_values(const ValuePicture& values, const ColourScale& scale) {
    std::size_t covered = 0;
    std::size_t above = 0;
    std::size_t below = 0;
    for (std::size_t i = 0; i < values.values.size(); ++i) {
        if (values.cloth[i] == 0) {
            continue;
        }
        ++covered;
        above += static_cast<double>(values.values[i]) > scale.high ? 1U : 0U;
        below += static_cast<double>(values.values[i]) < scale.low ? 1U : 0U;
    }
    const auto fraction = [](std::size_t part, std::size_t whole) {
        return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
    };
    PictureStats stats;
    stats.covered_share = fraction(covered, values.values.size());
    stats.above_share = fraction(above, covered);
    stats.below_share = fraction(below, covered);
    return stats;
}

std::array<double, 3> mean_colour(const Image& image) {
    std::array<std::size_t, 3> sum{};
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
        sum[i % 3] += image.rgb[i];
    }
    const double scale =
        image.rgb.empty() ? 0.0 : 3.0 / (255.0 * static_cast<double>(image.rgb.size()));
    return {static_cast<double>(sum[0]) * scale, static_cast<double>(sum[1]) * scale,
            static_cast<double>(sum[2]) * scale};
}

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
    const DrawnScene scene = build_drawn_scene(frame, quantity_, bounds_, camera_.eye);
    ValuePicture values;
    Image image = painter_->paint(scene, stats == nullptr ? nullptr : &values);
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
