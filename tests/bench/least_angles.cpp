/// least_angles SCENE: for each cloth of a scene that adapts, the least angle (degrees) of its rest
/// triangles as imported, and the least that refinement up to its levels can bring about, which no
/// frame of a run goes below (least_angle_deg in stats.csv).

#include "adapt/rest_split.h"
#include "remesh/adapt_world.h"
#include "scene/scene_reader.h"
#include "state/build_world.h"

#include <fmt/core.h>

#include <cstdio>
#include <numbers>

namespace weft {

namespace {

void print_angles(const std::filesystem::path& scene) {
    constexpr double k_degree = std::numbers::pi / 180.0;
    World world = build_world(read_scene(scene), [](const std::string&) {});
    make_adaptive(world);
    fmt::print("cloth,triangles,levels,angle_deg,bound_deg\n");
    for (const Cloth& cloth : world.cloths) {
        if (!cloth.refinement.empty()) {
            const auto levels = static_cast<Index>(cloth.params.adapt.levels);
            fmt::print("{},{},{},{:.4g},{:.4g}\n", cloth.name, cloth.triangles.size(), levels,
                       least_rest_angle(cloth) / k_degree,
                       least_refined_angle(cloth, levels) / k_degree);
        }
    }
}

} // namespace

} // namespace weft

int main(int count, char** arguments) {
    if (count != 2) {
        fmt::print(stderr, "least_angles SCENE\n");
        return 2;
    }
    try {
        weft::print_angles(arguments[1]);
        return 0;
    } catch (const std::exception& e) {
        fmt::print(stderr, "least_angles: {}\n", e.what());
        return 1;
    }
}
