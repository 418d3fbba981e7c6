#pragma once

#include "base/parallel.h"
#include "collide/contact_surface.h"
#include "geometry/box_tree.h"

namespace weft {

/// How an object takes part while crossings are taken apart.
enum class TangleRole : std::uint8_t {
    Moves,  ///< cloth of the layer at hand
    Stands, ///< obstacles, and cloth of the layers below
    Absent, ///< cloth of the layers above, whose turn comes later
};

/// A surface of which part can be moved to take crossings apart.
struct Tangle {
    ContactSurface surface;
    std::vector<TangleRole> roles; ///< #objects
    std::vector<Vec3> x;           ///< #V of the surface, m
    std::vector<double> mobility;  ///< #V: 1 where vertices move, else 0

    const ContactObject& object_of(Index triangle) const {
        const auto vertex = surface.triangles[static_cast<std::size_t>(triangle)][0];
        const auto object = surface.object_of_vertex[static_cast<std::size_t>(vertex)];
        return surface.objects[static_cast<std::size_t>(object)];
    }
    bool stands(Index triangle) const {
        const auto vertex = surface.triangles[static_cast<std::size_t>(triangle)][0];
        return mobility[static_cast<std::size_t>(vertex)] == 0.0;
    }
    std::array<Vec3, 3> corners(Index triangle) const {
        const Triangle& t = surface.triangles[static_cast<std::size_t>(triangle)];
        const auto at = [&](std::size_t k) { return x[static_cast<std::size_t>(t[k])]; };
        return {at(0), at(1), at(2)};
    }
};

/// All surfaces of a world as they stand at world.time, nothing moving yet.
Tangle make_tangle(const World& world);

/// Gives an object its role, and its vertices the mobility that goes with it.
void set_role(Tangle& tangle, std::size_t object, TangleRole role);

/// Two triangles whose boxes come together; the first one moves.
struct NearPair {
    Index first, second;
    bool crosses;
};

/// Finds pairs of triangles that are near or cross; keeps trees between calls.
class NearPairSearch {
public:
    /// @param self whether what moves is compared with itself
    NearPairSearch(const Tangle& tangle, bool self);

    /// Pairs of a moving triangle and another that moves or stands whose boxes, larger by half of
    /// `margin` (m) each, overlap; sorted.
    void find(const Tangle& tangle, double margin, std::vector<NearPair>& pairs);

private:
    void gather(const Tangle& tangle,
                const BoxTree& a,
                const BoxTree& b,
                std::span<const Index> of_b,
                std::vector<NearPair>& pairs);

    bool self_;
    std::vector<Index> moving_, standing_; ///< triangles
    std::vector<Box> boxes_;
    BoxTree moving_tree_, standing_tree_;
    double standing_margin_ = -1.0; ///< that the tree of what stands was fitted with
    std::vector<BoxTree::Task> tasks_;
    ChunkLists<NearPair> tasks_found_;
};

/// A constraint on up to four vertices of a tangle: normal . (sum of weight times position) >=
/// least.
struct Push {
    std::array<Index, 4> vertices; ///< k_no_index: none
    std::array<double, 4> weights;
    Vec3 normal; ///< unit
    double least;
};

/// Moves the vertices of a push the shortest way, each by its mobility, to where it is met; by at
/// most `limit` (m).
void apply(const Push& push, double limit, Tangle& tangle);

/// Constraints that keep pairs which do not cross apart by a clearance: vertices against faces and
/// edges against edges, along their shortest connection.
/// @param clearance  wanted, as a fraction of the pair's thickness
void find_clearance_pushes(const Tangle& tangle,
                           std::span<const NearPair> pairs,
                           double clearance,
                           std::vector<Push>& pushes);

/// Constraints that shorten the curves in which moving cloth crosses itself or other moving cloth:
/// each edge that pierces a face moves against it by `step` (m).
void find_contour_pushes(const Tangle& tangle,
                         std::span<const NearPair> pairs,
                         double step,
                         std::vector<Push>& pushes);

} // namespace weft
