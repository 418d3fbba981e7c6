#pragma once

#include "base/parallel.h"
#include "collide/contact_surface.h"
#include "geometry/box_tree.h"
#include "geometry/distance.h"

namespace weft {

/// Pairs are looked at within this many thicknesses: resting pairs, which stand at one thickness,
/// neither leave contact nor enter it anew in each substep.
inline constexpr double k_reach = 1.25;

/// A pair to look at.
struct Candidate {
    std::array<Index, 4> vertices; ///< indices in ContactSurface, in the order of PairKind
    /// VertexFace: the triangle, twice. EdgeEdge: the triangles that speak for the edges.
    std::array<Index, 2> triangles;
    Index rule; ///< index in ContactSurface::rules
    PairKind kind;
};

/// Finds candidates with one tree of triangles for all deformables and one an obstacle. Each vertex
/// and edge is looked at through the one triangle that speaks for it, so that a pair comes once.
/// Source: Curtis et al. 2008 (representative triangles).
class BroadPhase {
public:
    /// @param self whether deformables meet each other and themselves
    BroadPhase(const ContactSurface& surface, bool self);

    /// All pairs that may come nearer than their reach while each vertex moves along its line for
    /// `dt`, or ends up to half a thickness aside; in an order that the surface alone determines.
    /// Pairs that share a vertex (see ContactSurface::are_one), and pairs of infinite masses only,
    /// are left out.
    void find(const ContactSurface& surface, double dt, std::vector<Candidate>& candidates);

    /// Takes the deformables' mesh anew, the obstacles as they were.
    /// @param start #V deformable: positions that the tree's splits are made of, m; given the same
    ///              ones, pairs come in the same order
    void remesh(const ContactSurface& surface, std::span<const Vec3> start);

    /// Whether deformables are looked at against each other.
    bool looks_at_self() const { return self_; }

    /// Calls f(triangle of the surface) for all triangles whose motion in the last find() came near
    /// the box; for those of deformables only when they meet each other.
    template <typename F>
    void for_each_near(const ContactSurface& surface, const Box& box, const F& f) const {
        if (self_) {
            deformables_.query(box, f);
        }
        for (std::size_t o = 0; o < obstacles_.size(); ++o) {
            const Index first = surface.objects[o].first_triangle;
            obstacles_[o].query(box, [&](Index t) { f(first + t); });
        }
    }

    /// The same for each box of a tree: f(item of the tree, triangle of the surface).
    template <typename F>
    void for_each_near(const ContactSurface& surface, const BoxTree& boxes, const F& f) const {
        const auto compare = [&](const BoxTree& tree, Index first) {
            if (!tree.empty() && !boxes.empty()) {
                BoxTree::overlaps(boxes, tree, {0, 0}, [&](Index i, Index t) { f(i, first + t); });
            }
        };
        if (self_) {
            compare(deformables_, 0);
        }
        for (std::size_t o = 0; o < obstacles_.size(); ++o) {
            compare(obstacles_[o], surface.objects[o].first_triangle);
        }
    }

    /// True while the candidates of the last find() hold for the present velocities.
    bool covers(const ContactSurface& surface, double dt) const;

private:
    /// Part of the surface.
    struct Range {
        std::size_t first_vertex, end_vertex, first_triangle, end_triangle;
    };
    /// The motion that an obstacle's tree was fitted to; equal ones sweep the same space.
    struct FittedMotion {
        Pose start{}, end{};
        std::uint64_t number = 0; ///< ContactObject::motion_number
        bool operator==(const FittedMotion& other) const;
    };
    /// Fits the tree to the space that a range sweeps, seen from a frame that moves with
    /// `frame_velocity`.
    void fit(const ContactSurface& surface,
             const Range& range,
             const Vec3& frame_velocity,
             double dt,
             BoxTree& tree);
    void gather(const ContactSurface& surface,
                const BoxTree& a,
                const BoxTree& b,
                Index first_b,
                std::vector<Candidate>& candidates);
    void
    look_at(const ContactSurface& surface, Index s, Index t, std::vector<Candidate>& out) const;

    bool self_;
    bool is_any_off_ = false;   ///< whether there are objects that do not touch
    std::vector<double> reach_; ///< margin of each object's boxes, m
    std::vector<double> slack_; ///< how far a vertex of each object may end aside, m
    std::vector<Box> vertex_boxes_, triangle_boxes_;
    std::vector<std::array<Box, 3>> side_boxes_; ///< by triangle, opposite to its corners
    std::vector<Vec3> seen_velocity_;            ///< #V deformable, at the last find()
    Vec3 frame_velocity_ = Vec3::Zero();         ///< mean of them
    BoxTree deformables_;
    std::vector<BoxTree> obstacles_; ///< one an object of the surface; empty for deformables
    std::vector<FittedMotion> fitted_motions_; ///< by object
    std::vector<char> is_fitted_;              ///< whether that holds
    std::vector<BoxTree::Task> tasks_;
    ChunkLists<Candidate> tasks_found_;
};

} // namespace weft
