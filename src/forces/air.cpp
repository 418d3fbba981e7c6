#include "forces/air.h"

#include <cmath>

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
    if (acts()) {
        set_triangles(cloth);
    }
}

std::vector<Index> AirElements::remesh(const Cloth& cloth, const ClothChanges& changes) {
    reference_.clear();
    if (!acts()) {
        return {};
    }
    update_triangles(cloth, changes);
    return changes.triangles;
}

double AirElements::energy_of(std::size_t face, std::span<const Vec3> x) const {
    const auto [x0, x1, x2] = gather(face, x);
    return -pressure_ / 6.0 * x0.dot(x1.cross(x2));
}

AirForce
AirElements::on_face(std::size_t face, std::span<const Vec3> x, std::span<const Vec3> v) const {
    const auto [x0, x1, x2] = gather(face, x);
    const auto mean = [&](std::span<const Vec3> values) {
        const auto [v0, v1, v2] = gather(face, values);
        return Vec3((v0 + v1 + v2) / 3.0);
    };
    const Vec3 doubled_area_normal = (x1 - x0).cross(x2 - x0);
    const Vec3 velocity = mean(v);
    const Vec3 tangent_at = reference_.empty() ? velocity : mean(reference_);
    AirForce air = air_drag(doubled_area_normal, tangent_at - wind_, density_);
    air.force -= air.damping * (velocity - tangent_at);
    air.force += 0.5 * pressure_ * doubled_area_normal;
    return air;
}

std::array<Vec3, 3>
AirElements::force_of(std::size_t face, std::span<const Vec3> x, std::span<const Vec3> v) const {
    const Vec3 third = on_face(face, x, v).force / 3.0;
    return {third, third, third};
}

ElementTerms<3> AirElements::terms_of(std::size_t face,
                                      std::span<const Vec3> x,
                                      std::span<const Vec3> v,
                                      SystemScales scales) const {
    const AirForce air = on_face(face, x, v);
    ElementTerms<3> terms;
    terms.force.fill(air.force / 3.0);
    terms.stiffness.fill(scales.damping / 9.0 * air.damping);
    return terms;
}

} // namespace weft
