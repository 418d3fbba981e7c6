#include "forces/air.h"

#include "base/parallel.h"

#include <algorithm>
#include <cassert>

namespace weft {

AirForce air_drag(const Vec3& doubled_area_normal, const Vec3& relative_velocity, double density) {
    const double doubled_area = doubled_area_normal.norm();
    if (!(doubled_area > 0.0)) {
        return {Vec3::Zero(), Mat3::Zero()};
    }
    const Vec3 n = doubled_area_normal / doubled_area;
    const double across = relative_velocity.dot(n);
    const Vec3 along = relative_velocity - across * n;
    const double speed = along.norm();
    const double scale = 0.25 * density * doubled_area; // rho/2 A
    AirForce air;
    air.force =
        -scale * (k_plate_drag * std::abs(across) * across * n + k_skin_friction * speed * along);
    air.damping = scale * 2.0 * k_plate_drag * std::abs(across) * n * n.transpose();
    if (speed > 0.0) {
        air.damping +=
            scale * k_skin_friction *
            (speed * (Mat3::Identity() - n * n.transpose()) + along * along.transpose() / speed);
    }
    return air;
}

AirElements::AirElements(const Cloth& cloth, const SceneParams& scene)
    : density_(scene.air_density), wind_(scene.wind), pressure_(cloth.params.pressure) {
    if (!acts()) {
        return;
    }
    nodes_.reserve(3 * cloth.triangles.size());
    for (const Triangle& t : cloth.triangles) {
        nodes_.insert(nodes_.end(), t.begin(), t.end());
    }
}

std::vector<Index> AirElements::update(const Cloth& cloth, const ClothChanges& changes) {
    reference_.clear();
    if (!acts()) {
        return {};
    }
    nodes_.resize(3 * cloth.triangles.size());
    for (const Index slot : changes.triangles) {
        const auto t = static_cast<std::size_t>(slot);
        std::copy(cloth.triangles[t].begin(), cloth.triangles[t].end(), &nodes_[3 * t]);
    }
    return changes.triangles;
}

double AirElements::energy(std::span<const Vec3> x) const {
    if (pressure_ == 0.0) {
        return 0.0;
    }
    return parallel_sum(size(), [&](std::size_t t) {
        const Vec3& x0 = x[static_cast<std::size_t>(nodes_[3 * t])];
        const Vec3& x1 = x[static_cast<std::size_t>(nodes_[3 * t + 1])];
        const Vec3& x2 = x[static_cast<std::size_t>(nodes_[3 * t + 2])];
        return -pressure_ / 6.0 * x0.dot(x1.cross(x2));
    });
}

AirForce
AirElements::on_face(std::size_t t, std::span<const Vec3> x, std::span<const Vec3> v) const {
    const auto i0 = static_cast<std::size_t>(nodes_[3 * t]);
    const auto i1 = static_cast<std::size_t>(nodes_[3 * t + 1]);
    const auto i2 = static_cast<std::size_t>(nodes_[3 * t + 2]);
    const Vec3 doubled_area_normal = (x[i1] - x[i0]).cross(x[i2] - x[i0]);
    const Vec3 velocity = (v[i0] + v[i1] + v[i2]) / 3.0;
    const Vec3 tangent_at = reference_.empty()
                                ? velocity
                                : Vec3((reference_[i0] + reference_[i1] + reference_[i2]) / 3.0);
    AirForce air = air_drag(doubled_area_normal, tangent_at - wind_, density_);
    air.force -= air.damping * (velocity - tangent_at);
    air.force += 0.5 * pressure_ * doubled_area_normal;
    return air;
}

void AirElements::forces(std::span<const Vec3> x,
                         std::span<const Vec3> v,
                         std::span<Vec3> element_forces) const {
    assert(element_forces.size() == 3 * size());
    parallel_for(size(), [&](std::size_t t) {
        const Vec3 third = on_face(t, x, v).force / 3.0;
        for (std::size_t k = 0; k < 3; ++k) {
            element_forces[3 * t + k] = third;
        }
    });
}

void AirElements::evaluate(std::span<const Vec3> x,
                           std::span<const Vec3> v,
                           SystemScales scales,
                           std::span<Vec3> element_forces,
                           std::span<Mat3> element_blocks) const {
    assert(element_forces.size() == 3 * size() && element_blocks.size() == 6 * size());
    parallel_for(size(), [&](std::size_t t) {
        const AirForce air = on_face(t, x, v);
        const Vec3 third = air.force / 3.0;
        const Mat3 ninth = scales.damping / 9.0 * air.damping;
        for (std::size_t k = 0; k < 3; ++k) {
            element_forces[3 * t + k] = third;
        }
        for (std::size_t b = 0; b < 6; ++b) {
            element_blocks[6 * t + b] = ninth;
        }
    });
}

} // namespace weft
