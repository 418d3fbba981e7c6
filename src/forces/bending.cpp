#include "forces/bending.h"

#include "forces/element_terms.h"

#include <cassert>

namespace weft {

namespace {

double doubled_area(const RestCorners& c) {
    const Vec2 a = c[1] - c[0];
    const Vec2 b = c[2] - c[0];
    return std::abs(a.x() * b.y() - a.y() * b.x());
}

/// Jumps of the three edges as functions of the six nodes; zero where there is no neighbour.
std::array<std::array<double, 6>, 3> patch_jumps(const BendPatch& patch) {
    std::array<std::array<double, 6>, 3> jumps{};
    for (std::size_t k = 0; k < 3; ++k) {
        if (!patch.has_neighbour[k]) {
            continue;
        }
        const std::size_t a = (k + 1) % 3;
        const std::size_t b = (k + 2) % 3;
        const auto jump = edge_jump({rest_cotangent(patch.corners, static_cast<int>(a)),
                                     rest_cotangent(patch.neighbours[k], 2)},
                                    {rest_cotangent(patch.corners, static_cast<int>(b)),
                                     rest_cotangent(patch.neighbours[k], 1)});
        jumps[k][a] = jump[0];
        jumps[k][b] = jump[1];
        jumps[k][k] = jump[2];
        jumps[k][3 + k] = jump[3];
    }
    return jumps;
}

} // namespace

double rest_cotangent(const RestCorners& corners, int k) {
    const Vec2& at = corners[static_cast<std::size_t>(k)];
    const Vec2 a = corners[static_cast<std::size_t>((k + 1) % 3)] - at;
    const Vec2 b = corners[static_cast<std::size_t>((k + 2) % 3)] - at;
    const double area = doubled_area(corners);
    assert(area > 0.0);
    return a.dot(b) / area;
}

std::array<double, 4> edge_jump(const std::array<double, 2>& cot0,
                                const std::array<double, 2>& cot1) {
    return {cot1[0] + cot1[1], cot0[0] + cot0[1], -cot0[0] - cot1[0], -cot0[1] - cot1[1]};
}

std::array<double, 10>
hinge_bend_stiffness(const std::array<double, 4>& jump, double area_sum, double rigidity) {
    assert(area_sum > 0.0);
    std::array<double, 10> q{};
    for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = a; b < 4; ++b) {
            q[block_index(4, static_cast<int>(a), static_cast<int>(b))] =
                rigidity / area_sum * jump[a] * jump[b];
        }
    }
    return q;
}

std::array<double, 21> mid_edge_bend_stiffness(const BendPatch& patch, double rigidity) {
    const double area = 0.5 * doubled_area(patch.corners);
    const auto jumps = patch_jumps(patch);
    std::array<double, 3> weights{};
    std::array<Vec2, 3> directions;
    for (std::size_t k = 0; k < 3; ++k) {
        weights[k] =
            patch.has_neighbour[k] ? area / (area + 0.5 * doubled_area(patch.neighbours[k])) : 0.0;
        directions[k] = (patch.corners[(k + 2) % 3] - patch.corners[(k + 1) % 3]).normalized();
    }
    std::array<double, 21> q{};
    for (std::size_t e = 0; e < 3; ++e) {
        for (std::size_t f = 0; f < 3; ++f) {
            const double cosine = directions[e].dot(directions[f]); // = n_e.n_f
            const double scale = rigidity / area * weights[e] * weights[f] * cosine * cosine;
            for (std::size_t a = 0; a < 6; ++a) {
                for (std::size_t b = a; b < 6; ++b) {
                    q[block_index(6, static_cast<int>(a), static_cast<int>(b))] +=
                        scale * jumps[e][a] * jumps[f][b];
                }
            }
        }
    }
    return q;
}

} // namespace weft
