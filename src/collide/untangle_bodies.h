#pragma once

#include "collide/tangle.h"
#include "geometry/hull_gap.h"
#include "geometry/nearest_surface.h"

namespace weft {

/// An object that stands and has an outer side: an obstacle, or cloth of a layer below.
struct StandingBody {
    Index object;           ///< number in the surface
    double side;            ///< 1: outside is where its triangles' normals point; -1: the other way
    NearestSurface surface; ///< turned so that normals point outside
};

/// The bodies among the objects that stand. A closed obstacle's outside is where its normals point;
/// that of cloth among obstacles is away from them; any other body's is where more of the moving
/// cloth is.
std::vector<StandingBody> find_bodies(const Tangle& tangle);

/// The constraints that take moving cloth out of bodies: vertices that are behind a body's surface,
/// or before it by less than the clearance, and triangles over triangles.
class BodyPushes {
public:
    explicit BodyPushes(const Tangle& tangle);

    /// @param pairs near pairs of now. The part of the cloth behind a body is found from the pairs
    ///              that cross, over the cloth's edges; what was found once stays looked at.
    /// @param clearance  wanted, as a fraction of the pair's thickness
    void find(const Tangle& tangle,
              std::span<const NearPair> pairs,
              double clearance,
              std::vector<Push>& pushes);

private:
    void find_columns(const Tangle& tangle,
                      const NearPair& pair,
                      double clearance,
                      std::vector<Push>& pushes);
    void find_vertices_behind(const Tangle& tangle,
                              std::span<const NearPair> pairs,
                              std::size_t body,
                              double clearance,
                              std::vector<Push>& pushes);
    Index first_vertex_of(const ContactSurface& surface, std::size_t body) const;

    std::vector<StandingBody> bodies_;
    std::vector<std::size_t> body_of_object_;  ///< #objects; past the end: none
    std::vector<std::vector<char>> looked_at_; ///< a body: #V
    std::vector<Index> front_;
    std::vector<ColumnGap> gaps_;
};

} // namespace weft
