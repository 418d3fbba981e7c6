#pragma once

#include "collide/broad_phase.h"

namespace weft {

/// One contact as a condition on velocities: along `normal` the sides must part at least as fast as
/// `least_speed`; what that takes allows friction in the plane across.
struct ContactRow {
    std::array<Index, 4> vertices; ///< of ContactSurface
    std::array<double, 4> weights; ///< as in Separation
    PairKind kind;
    Vec3 normal;              ///< unit, from side 2 to side 1
    double mass;              ///< that an impulse along the normal pushes, kg
    double least_speed;       ///< m/s
    double friction;          ///< Coulomb
    double drag_mass = 0.0;   ///< that one across it pushes, kg, at most
    double impulse = 0.0;     ///< along normal so far, N s, >= 0
    Vec3 drag = Vec3::Zero(); ///< across, so far, N s; |drag| <= friction * impulse
};

/// Share of an overlap that a substep of length dt (s) takes back: a tenth, and no more than
/// k_parting_rate dt.
double parting_share(double dt);

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

} // namespace weft
