#include "forces/rigid_elements.h"

#include "base/cross_matrix.h"
#include "base/parallel.h"

#include <Eigen/Dense>

#include <cassert>

namespace weft {

ElementTerms<4> rigid_terms(const FourPoints& x, const FourPoints& rest, double stiffness) {
    const Pose pose = nearest_pose(rest, x);
    ElementTerms<4> terms;
    std::array<Mat3, 4> arms; ///< cross matrices
    Mat3 inertia = Mat3::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 arm = pose.rotation * rest[i];
        const Vec3 off = x[i] - pose.translation - arm;
        arms[i] = cross_matrix(arm);
        inertia += arms[i] * arms[i].transpose();
        terms.energy += 0.5 * stiffness * off.squaredNorm();
        terms.force[i] = -stiffness * off;
    }
    const Mat3 inverse = inertia.inverse();
    for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = a; b < 4; ++b) {
            const double here = a == b ? 1.0 : 0.0;
            terms.stiffness[block_index(4, static_cast<int>(a), static_cast<int>(b))] =
                stiffness *
                ((here - 0.25) * Mat3::Identity() - arms[a] * inverse * arms[b].transpose());
        }
    }
    return terms;
}

RigidElements::RigidElements(const World& world) {
    for (const RigidBody& rigid : world.rigids) {
        rests_.push_back(rigid.rest);
        stiffness_.push_back(rigid.stiffness);
        for (Index i = 0; i < 4; ++i) {
            nodes_.push_back(rigid.body.first_particle + i);
        }
    }
}

ElementTerms<4> RigidElements::terms(std::size_t body, std::span<const Vec3> x) const {
    const auto node = [&](std::size_t i) {
        return x[static_cast<std::size_t>(nodes_[4 * body + i])];
    };
    return rigid_terms({node(0), node(1), node(2), node(3)}, rests_[body], stiffness_[body]);
}

double RigidElements::energy(std::span<const Vec3> x) const {
    return parallel_sum(size(), [&](std::size_t e) { return terms(e, x).energy; });
}

void RigidElements::forces(std::span<const Vec3> x,
                           std::span<const Vec3>,
                           std::span<Vec3> element_forces) const {
    assert(element_forces.size() == 4 * size());
    parallel_for(size(), [&](std::size_t e) {
        const auto force = terms(e, x).force;
        std::copy(force.begin(), force.end(), element_forces.begin() + static_cast<long>(4 * e));
    });
}

void RigidElements::evaluate(std::span<const Vec3> x,
                             std::span<const Vec3>,
                             SystemScales scales,
                             std::span<Vec3> element_forces,
                             std::span<Mat3> element_blocks) const {
    assert(element_forces.size() == 4 * size() && element_blocks.size() == 10 * size());
    parallel_for(size(), [&](std::size_t e) {
        const ElementTerms<4> result = terms(e, x);
        std::copy(result.force.begin(), result.force.end(),
                  element_forces.begin() + static_cast<long>(4 * e));
        for (std::size_t b = 0; b < 10; ++b) {
            element_blocks[10 * e + b] = scales.stiffness * result.stiffness[b];
        }
    });
}

} // namespace weft
