#pragma once

#include "adapt/change_log.h"
#include "base/eigen.h"
#include "geometry/mesh_edit.h"
#include "state/cloth.h"
#include "state/refinement.h"

#include <functional>
#include <limits>
#include <vector>

namespace weft {

/// Where a vertex stands among its parents: x = sum of weights[k] x[parents[k]]. Three thirds of a
/// triangle's corners, or 2/3 and 1/3 of an edge's ends; then parents[2] = k_no_index, weight 0.
struct VertexParents {
    Index vertex;
    std::array<Index, 3> parents;
    std::array<double, 3> weights;
};

/// An edge between two triangles gives way to the edge between their apexes: (P, a, b) and
/// (Q, b, a) become (P, a, Q) and (Q, b, P). The surface sweeps the tetrahedron a b P Q.
struct EdgeFlip {
    std::array<Index, 2> edge; ///< a, b
    std::array<Index, 2> apex; ///< P, Q
};

/// The edits that remove a vertex, or the pair on an edge, in this order.
struct Removal {
    std::vector<EdgeFlip> flips;         ///< back to what was; `edge` is the one that goes
    std::vector<VertexParents> vertices; ///< these move to where their parents' mean is, and vanish
    std::vector<Triangle> merged;        ///< and these triangles are left
};

/// Calls from an adaptation to its caller, which may refuse edits. Empty functions allow all, or do
/// nothing. They must not edit the cloth. Vertices are the cloth's own, as they are at the time of
/// the call.
struct AdaptationHooks {
    std::function<bool(const EdgeFlip&)> may_flip;    ///< false: it waits for retry_flips()
    std::function<bool(const Removal&)> may_remove;   ///< false: nothing of it is done
    std::function<void(const VertexParents&)> insert; ///< is in the mesh now, on the old surface
    std::function<void(const VertexParents&)> remove; ///< before anything of a removal is done
    std::function<void(Index from, Index to)> move;   ///< in finish(); what stood in `to` is gone
};

/// 3^15 triangles for one; the record of parts has two bits for each level.
inline constexpr Index k_most_levels = 15;

/// Bounds of an adaptation.
struct AdaptationLimits {
    Index max_level = 0; ///< no triangle becomes finer, 0..k_most_levels
    Index max_triangles = std::numeric_limits<Index>::max(); ///< refining stops before more
    Index adaptation = 0; ///< number of this adaptation: `born` of the vertices that it puts in
};

/// Reversible sqrt(3) refinement of a cloth's mesh. Mesh, rest shape and records are functions of
/// the set of vertices put in, whatever the order they came and went in; without any, the cloth is
/// the imported one, bit for bit.
///
/// One adaptation, in this order:
///     Sqrt3Mesh mesh(cloth);               // once; needs make_refinement(cloth) before
///     mesh.begin(cloth, hooks, limits);
///     mesh.retry_flips();
///     for marked triangles t: mesh.refine(t)       // each may refine others that it rests on
///     for unmarked vertices v: if (mesh.can_remove(v)) mesh.remove(v)
///     ClothChanges changes = mesh.finish();
///
/// Between begin and finish slots keep their numbers: what is new stands behind, what is removed is
/// dead (corners k_no_index; see is_dead). finish() fills the gaps from behind, sets rest_areas,
/// which are those of before until then, and says what changed. A triangle refined keeps its slot
/// for one of its parts: refine(t) again goes on inside it.
///
/// Everything is proportional to what changes, but for the constructor and, once an adaptation, the
/// edges whose flip waits.
///
/// Source: Kobbelt 2000, "sqrt(3)-subdivision"; coarsening is ours (each slot keeps its way back).
class Sqrt3Mesh {
public:
    /// Builds what is kept beside the cloth: the triangles around each vertex.
    explicit Sqrt3Mesh(const Cloth& cloth);

    /// @param cloth  the one of the constructor, changed since by this object alone; it may have
    ///               moved in memory, and must stay where it is until finish()
    void begin(Cloth& cloth, AdaptationHooks hooks, const AdaptationLimits& limits);

    /// Whether refine(t) has a chance: neither the level limit nor a frozen triangle is in its way.
    bool can_refine(Index t) const;

    /// Refines triangle t once: even generation: cut into three about its barycentre; odd: flipped
    /// with its mate, which is refined first as far as it needs; odd on a boundary, a lock or
    /// a pair too skew to flip (k_least_flip_fraction): cut in three there. False when that is
    /// refused or the triangles allowed do not suffice; the mesh is sound then as well, but some of
    /// the triangles that t rests on may have been refined.
    bool refine(Index t);

    /// Whether v was put in and nothing finer rests on it. Dead and imported vertices: false.
    bool can_remove(Index v) const;

    /// Takes v, and the vertex that came with it on an edge, out again. False when may_remove says
    /// so. can_remove(v) must hold (asserted).
    bool remove(Index v);

    /// Tries the flips that were refused before. Returns how many were made.
    int retry_flips();

    /// Fills gaps, sets rest areas, ends the adaptation. Debug builds check the whole mesh.
    ClothChanges finish();

    /// The triangles around each vertex.
    const VertexStars& stars() const { return stars_; }

private:
    EditedMesh mesh() { return {cloth_->triangles, cloth_->topology}; }
    const Triangle& corners(Index t) const;
    const MeshEdge& edge(Index e) const;
    Index edge_of(Index t, std::size_t corner) const;
    int generation(Index t) const;
    std::uint32_t part(Index t, int generation) const;
    bool is_locked(Index e) const;
    bool is_odd(Index t) const { return generation(t) % 2 != 0; }
    bool are_equal_mates(Index e) const;
    bool is_cut_in_three(Index e) const;
    bool has_room_for(std::size_t triangles) const;
    bool waits_for_flip(Index e) const;

    void open(Index t);
    void close(Index t, int generation, const RestTriangle& rest);
    void set_part(Index t, int generation, std::uint32_t part);
    void make_slots();
    Index add_vertex(const VertexParents& place, InsertedVertex record);
    RestTriangle odd_rest(Index t, int generation) const;

    void split(Index t);
    void trisect(Index e);
    void cut_side(Index middle, Index first, Index last, int odd);
    bool try_flip(Index e);

    Index slot_of_part(Index v, std::uint32_t part) const;
    Removal removal_of_centre(Index v) const;
    Removal removal_of_pair(Index first) const;
    void add_flips_back(Index v, Removal& removal) const;
    void unflip_star(Index v);
    void unflip(Index e);
    void merge(Index v);
    void join(Index first);

    void move_vertex(Index from, Index to);
    void fill_gaps();
    void keep_waiting_flips();
    void set_rest_areas(ClothChanges& changes);

    Cloth* cloth_ = nullptr;
    AdaptationHooks hooks_;
    AdaptationLimits limits_;
    VertexStars stars_;
    ChangeLog log_;
    std::vector<Index> dead_vertices_, dead_edges_, dead_triangles_;
    mutable std::vector<Index> star_; ///< reused by can_remove and the like
};

} // namespace weft
