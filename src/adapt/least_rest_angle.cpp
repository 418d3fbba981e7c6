#include "adapt/least_rest_angle.h"

#include "adapt/rest_split.h"
#include "adapt/sqrt3_mesh.h"

#include <algorithm>
#include <cassert>
#include <numbers>

namespace weft {

namespace {

/// Refines every triangle as far as that level allows.
void refine_whole(Cloth& cloth, Index levels) {
    Sqrt3Mesh mesh(cloth);
    for (std::size_t before = 0; before != cloth.triangles.size();) {
        before = cloth.triangles.size();
        mesh.begin(cloth, {}, {.max_level = levels});
        mesh.retry_flips();
        for (std::size_t t = 0; t < before; ++t) {
            while (mesh.can_refine(static_cast<Index>(t)) && mesh.refine(static_cast<Index>(t))) {
            }
        }
        mesh.finish();
    }
}

/// Least angle of what was cut for an inserted vertex and of all parts that it was cut into. Of a
/// pair on an edge each has one side's triangle.
double least_angle_of_cut(const InsertedVertex& record) {
    const RestTriangle parent = parent_rest(record);
    if (parent.area == 0.0) { // beyond a boundary
        return std::numbers::pi / 3.0;
    }
    double least = least_angle(parent);
    for (std::uint32_t k = 0; k < 3; ++k) {
        const bool is_centre = record.insertion == Insertion::Centre;
        const RestTriangle part = is_centre ? split_rest(parent, k) : trisect_rest(parent, k);
        least = std::min(least, least_angle(part));
    }
    return least;
}

} // namespace

double least_rest_angle(const Cloth& cloth) {
    double least = std::numbers::pi / 3.0;
    for (const RestTriangle& rest : cloth.rest) {
        least = std::min(least, least_angle(rest));
    }
    return least;
}

double least_refined_angle(const Cloth& cloth, Index levels) {
    assert(!cloth.refinement.empty());
    Cloth refined = cloth;
    refine_whole(refined, levels);
    // A triangle that is there no more was cut, and the vertex put in remembers it; or it was a
    // part of such a cut and flipped.
    double least = least_rest_angle(refined);
    for (const InsertedVertex& record : refined.refinement.vertices) {
        least = std::min(least, least_angle_of_cut(record));
    }
    return least;
}

} // namespace weft
