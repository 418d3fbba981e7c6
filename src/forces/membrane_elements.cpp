#include "forces/membrane_elements.h"

#include "base/parallel.h"

#include <algorithm>
#include <cassert>

namespace weft {

namespace {

Corners corners_of(std::span<const Index> nodes, std::size_t t, std::span<const Vec3> values) {
    return {values[static_cast<std::size_t>(nodes[3 * t])],
            values[static_cast<std::size_t>(nodes[3 * t + 1])],
            values[static_cast<std::size_t>(nodes[3 * t + 2])]};
}

} // namespace

MembraneElements::MembraneElements(const Cloth& cloth)
    : stiffness_(membrane_stiffness(cloth.params.fabric)),
      damping_time_(cloth.params.fabric.damping(1)), rest_(cloth.rest) {
    assert(cloth.rest.size() == cloth.triangles.size());
    nodes_.reserve(3 * cloth.triangles.size());
    for (const Triangle& t : cloth.triangles) {
        nodes_.insert(nodes_.end(), t.begin(), t.end());
    }
}

std::vector<Index> MembraneElements::update(const Cloth& cloth, const ClothChanges& changes) {
    rest_.resize(cloth.triangles.size());
    nodes_.resize(3 * cloth.triangles.size());
    for (const Index slot : changes.triangles) {
        const auto t = static_cast<std::size_t>(slot);
        rest_[t] = cloth.rest[t];
        std::copy(cloth.triangles[t].begin(), cloth.triangles[t].end(), &nodes_[3 * t]);
    }
    return changes.triangles;
}

double MembraneElements::energy(std::span<const Vec3> x) const {
    return parallel_sum(size(), [&](std::size_t t) {
        return membrane_energy(corners_of(nodes_, t, x), rest_[t], stiffness_);
    });
}

void MembraneElements::forces(std::span<const Vec3> x,
                              std::span<const Vec3> v,
                              std::span<Vec3> element_forces) const {
    assert(element_forces.size() == 3 * size());
    parallel_for(size(), [&](std::size_t t) {
        const Corners force = membrane_forces(corners_of(nodes_, t, x), corners_of(nodes_, t, v),
                                              rest_[t], stiffness_, damping_time_);
        std::copy(force.begin(), force.end(), element_forces.begin() + static_cast<long>(3 * t));
    });
}

void MembraneElements::evaluate(std::span<const Vec3> x,
                                std::span<const Vec3> v,
                                SystemScales scales,
                                std::span<Vec3> element_forces,
                                std::span<Mat3> element_blocks) const {
    assert(element_forces.size() == 3 * size() && element_blocks.size() == 6 * size());
    parallel_for(size(), [&](std::size_t t) {
        const ElementTerms<3> terms =
            membrane_terms(corners_of(nodes_, t, x), corners_of(nodes_, t, v), rest_[t], stiffness_,
                           damping_time_, scales);
        std::copy(terms.force.begin(), terms.force.end(),
                  element_forces.begin() + static_cast<long>(3 * t));
        std::copy(terms.stiffness.begin(), terms.stiffness.end(),
                  element_blocks.begin() + static_cast<long>(6 * t));
    });
}

} // namespace weft
