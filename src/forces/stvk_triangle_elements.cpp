#include "forces/stvk_triangle_elements.h"

#include "base/parallel.h"

#include <algorithm>
#include <cassert>

namespace weft {

StvkTriangleElements::StvkTriangleElements(const Cloth& cloth)
    : stiffness_(stvk_stiffness(cloth.params)), damping_(cloth.params.spring.damping),
      rest_(cloth.rest) {
    nodes_.reserve(3 * cloth.triangles.size());
    for (const Triangle& t : cloth.triangles) {
        nodes_.insert(nodes_.end(), t.begin(), t.end());
    }
}

Corners StvkTriangleElements::corners(std::size_t t, std::span<const Vec3> values) const {
    const auto at = [&](std::size_t k) {
        return values[static_cast<std::size_t>(nodes_[3 * t + k])];
    };
    return {at(0), at(1), at(2)};
}

double StvkTriangleElements::energy(std::span<const Vec3> x) const {
    return parallel_sum(
        size(), [&](std::size_t t) { return stvk_energy(corners(t, x), rest_[t], stiffness_); });
}

void StvkTriangleElements::forces(std::span<const Vec3> x,
                                  std::span<const Vec3> v,
                                  std::span<Vec3> element_forces) const {
    assert(element_forces.size() == 3 * size());
    parallel_for(size(), [&](std::size_t t) {
        const Corners f = stvk_forces(corners(t, x), corners(t, v), rest_[t], stiffness_, damping_);
        std::copy(f.begin(), f.end(), element_forces.begin() + static_cast<long>(3 * t));
    });
}

void StvkTriangleElements::evaluate(std::span<const Vec3> x,
                                    std::span<const Vec3> v,
                                    SystemScales scales,
                                    std::span<Vec3> element_forces,
                                    std::span<Mat3> element_blocks) const {
    assert(element_forces.size() == 3 * size() && element_blocks.size() == 6 * size());
    parallel_for(size(), [&](std::size_t t) {
        const ElementTerms<3> terms =
            stvk_terms(corners(t, x), corners(t, v), rest_[t], stiffness_, damping_, scales);
        std::copy(terms.force.begin(), terms.force.end(),
                  element_forces.begin() + static_cast<long>(3 * t));
        std::copy(terms.stiffness.begin(), terms.stiffness.end(),
                  element_blocks.begin() + static_cast<long>(6 * t));
    });
}

} // namespace weft
