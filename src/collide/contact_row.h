#pragma once

#include "collide/broad_phase.h"

namespace weft {

/// One contact as a condition on velocities: along `normal` the sides must part at least as fast as
/// `least_speed`; what that takes allows friction.
struct ContactRow {
    std::array<Index, 4> vertices; ///< indices in ContactSurface
    std::array<double, 4> weights; ///< as in Separation
    PairKind kind;
    Vec3 normal;                  ///< unit, from side 2 to side 1
    double mass;                  ///< that an impulse along the normal pushes, kg
    double least_speed;           ///< m/s
    double friction;              ///< Coulomb
    double tangential_mass = 0.0; ///< that a tangential impulse pushes, kg, at most
    double impulse = 0.0;         ///< along normal so far, N s, >= 0
    /// Tangential, so far, N s; its length is at most friction * impulse.
    Vec3 friction_impulse = Vec3::Zero();
};

/// Fraction of an overlap that a substep of length dt (s) takes back: a tenth, and no more than
/// k_parting_rate dt.
double parting_fraction(double dt);

/// The condition that keeps a pair, seen at `place`, from being nearer than `thickness` along its
/// normal when the substep ends. Pairs nearer than that at the start do not come nearer, and part
/// with at most a tenth of the overlap a substep and k_parting_rate times the overlap a second.
/// Source: Bridson et al. 2002, section 7.2; for pairs further apart the speed that just reaches
/// the thickness.
ContactRow make_row(const ContactSurface& surface,
                    const Candidate& candidate,
                    const Separation& place,
                    double dt);

/// One round of impulses in the order of the rows: each row is set right, given what the others
/// have done; normal impulses only push in sum, and friction stays within Coulomb's cone. Returns
/// the largest change of a relative velocity, m/s. Sets touched[v] = 1 for vertices it changed.
/// Source: projected Gauss-Seidel; of a single contact the same as Bridson et al. 2002, section
/// 7.3.
double sweep(std::span<ContactRow> rows, ContactSurface& surface, std::span<char> touched);

/// Positions of a pair at the start, and its displacements over dt.
PairPoints start_points(const ContactSurface& surface, const std::array<Index, 4>& vertices);
PairPoints
displacements(const ContactSurface& surface, const std::array<Index, 4>& vertices, double dt);

// An impulse acts on a vertex that is solved for through its mass, on one that particles carry
// through these, and on a rigid body as a whole. An embedded vertex has the velocity of its
// particles; what the surface holds for it is brought up to date by follow_particles().

/// Velocity of a vertex, m/s.
Vec3 velocity_of(const ContactSurface& surface, Index vertex);

/// The mass that an impulse at a pair moves, kg; 0 where all masses are infinite.
struct PairMass {
    double along;      ///< the normal
    double tangential; ///< to the pair, at least
};

/// @param weights as in Separation
PairMass mass_of_pair(const ContactSurface& surface,
                      const std::array<Index, 4>& vertices,
                      const std::array<double, 4>& weights,
                      const Vec3& normal);

/// Gives each vertex weight * impulse (N s). Sets touched[v] = 1 for those solved for.
void push_pair(ContactSurface& surface,
               const std::array<Index, 4>& vertices,
               const std::array<double, 4>& weights,
               const Vec3& impulse,
               std::span<char> touched);

/// Carried vertices of bodies of which a particle is touched take its velocity and are touched.
void follow_particles(ContactSurface& surface, std::span<char> touched);

} // namespace weft
