#include "forces/rigid_elements.h"

#include "base/eigen.h"

#include <Eigen/Dense>

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

double RigidElements::energy_of(std::size_t body, std::span<const Vec3> x) const {
    return rigid_terms(gather(body, x), rests_[body], stiffness_[body]).energy;
}

ElementTerms<4> RigidElements::terms_of(std::size_t body,
                                        std::span<const Vec3> x,
                                        std::span<const Vec3>,
                                        SystemScales scales) const {
    ElementTerms<4> terms = rigid_terms(gather(body, x), rests_[body], stiffness_[body]);
    for (Mat3& block : terms.stiffness) {
        block *= scales.stiffness;
    }
    return terms;
}

} // namespace weft
