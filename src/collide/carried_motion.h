#pragma once

#include "collide/contact_surface.h"

namespace weft {

/// What impulses do to a surface: to a vertex that is solved for through its mass, to a carried one
/// through the particles that carry it, of rigid bodies as a whole. Velocities of carried vertices
/// are those of their particles; the ones kept on the surface follow in follow_particles().

/// Velocity of a vertex, m/s.
Vec3 velocity_of(const ContactSurface& surface, Index vertex);

/// What impulses at a pair push against, kg; 0: infinite mass alone.
struct PairMass {
    double along;  ///< the normal
    double across; ///< it, at least
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
