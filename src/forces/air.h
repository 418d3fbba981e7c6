#pragma once

#include "forces/elements.h"
#include "scene/params.h"

namespace weft {

/// Drag coefficient of a plate across the stream (square plate: 1.17, long strip: 2.0).
inline constexpr double k_plate_drag = 1.2;

/// Skin friction coefficient along the stream, both sides together (turbulent flat plate at
/// Reynolds number 1e5: 0.007 a side).
inline constexpr double k_skin_friction = 0.015;

/// Force of the air on one face and minus its derivative by the face's velocity.
struct AirForce {
    Vec3 force;   ///< N
    Mat3 damping; ///< N s/m, symmetric positive semidefinite
};

/// -rho/2 A (c_n |u.n| (u.n) n + c_t |u_t| u_t), u the face's velocity relative to the air; never
/// gives power to a face in still air.
///
/// @param doubled_area_normal  (x1 - x0) x (x2 - x0), m^2
AirForce air_drag(const Vec3& doubled_area_normal, const Vec3& relative_velocity, double density);

/// Wind, drag and inner pressure on the faces of a cloth, a third on each corner. The blocks hold
/// the drag's dependence on velocity alone.
class AirElements : public ElementLoops<AirElements, 3> {
public:
    /// No elements without air and pressure.
    AirElements(const Cloth& cloth, const SceneParams& scene);

    /// Forgets what drag was linearised at.
    std::vector<Index> remesh(const Cloth& cloth, const ClothChanges& changes);

    /// From now on drag is linear in the velocity, tangent to the law at these velocities (#V of
    /// the cloth, m/s): an implicit step whose first iterate is far from them still sees the right
    /// drag.
    void linearise_at(std::span<const Vec3> v) { reference_.assign(v.begin(), v.end()); }

    /// Potential of the pressure, -p times the volume between the face and the origin: the sum is
    /// that of the enclosed volume of a closed cloth. Drag has none.
    double energy_of(std::size_t face, std::span<const Vec3> x) const;
    std::array<Vec3, 3>
    force_of(std::size_t face, std::span<const Vec3> x, std::span<const Vec3> v) const;
    ElementTerms<3> terms_of(std::size_t face,
                             std::span<const Vec3> x,
                             std::span<const Vec3> v,
                             SystemScales scales) const;

private:
    bool acts() const { return density_ > 0.0 || pressure_ != 0.0; }
    AirForce on_face(std::size_t face, std::span<const Vec3> x, std::span<const Vec3> v) const;

    double density_;              ///< kg/m^3
    Vec3 wind_;                   ///< m/s
    double pressure_;             ///< Pa
    std::vector<Vec3> reference_; ///< #V, m/s; empty: the law itself
};

} // namespace weft
