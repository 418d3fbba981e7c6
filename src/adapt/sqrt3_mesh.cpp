#include "adapt/sqrt3_mesh.h"

#include "adapt/adaptive_cloth.h"
#include "adapt/rest_split.h"
#include "geometry/curvature.h"

#include <algorithm>
#include <cassert>

namespace weft {

namespace {

/// Place of an odd generation's part in TriangleLevel::parts.
int part_shift(int generation) {
    assert(generation % 2 != 0 && generation < 2 * k_most_levels + 2);
    return generation - 1;
}

} // namespace

Sqrt3Mesh::Sqrt3Mesh(const Cloth& cloth) : stars_(cloth.triangles, cloth.vertex_count) {
    assert(!cloth.refinement.empty());
}

void Sqrt3Mesh::begin(Cloth& cloth, AdaptationHooks hooks, const AdaptationLimits& limits) {
    assert(cloth_ == nullptr);
    assert(0 <= limits.max_level && limits.max_level <= k_most_levels);
    assert(cloth.refinement.triangles.size() == cloth.triangles.size());
    cloth_ = &cloth;
    hooks_ = std::move(hooks);
    limits_ = limits;
    log_.begin(cloth);
}

const Triangle& Sqrt3Mesh::corners(Index t) const {
    return cloth_->triangles[at(t)];
}

const MeshEdge& Sqrt3Mesh::edge(Index e) const {
    return cloth_->topology.edges[at(e)];
}

Index Sqrt3Mesh::edge_of(Index t, std::size_t corner) const {
    return cloth_->topology.triangle_edges[at(t)][corner];
}

int Sqrt3Mesh::generation(Index t) const {
    return cloth_->refinement.triangles[at(t)].generation;
}

std::uint32_t Sqrt3Mesh::part(Index t, int generation) const {
    return (cloth_->refinement.triangles[at(t)].parts >> part_shift(generation)) & 3U;
}

void Sqrt3Mesh::set_part(Index t, int generation, std::uint32_t part) {
    std::uint32_t& parts = cloth_->refinement.triangles[at(t)].parts;
    parts = (parts & ~(3U << part_shift(generation))) | (part << part_shift(generation));
}

bool Sqrt3Mesh::is_locked(Index e) const {
    return cloth_->refinement.locked[at(e)] != 0;
}

/// Two odd triangles of one generation share their mate edge.
bool Sqrt3Mesh::are_equal_mates(Index e) const {
    const auto [A, B] = edge(e).triangle;
    if (B == k_no_index || !is_odd(A) || generation(A) != generation(B)) {
        return false;
    }
    const bool are_mates = edge_of(A, 0) == e && edge_of(B, 0) == e;
    // Siblings are cut off together: they share a spoke, opposite to no apex.
    assert(are_mates || corners(A)[0] == corners(B)[0]);
    return are_mates;
}

/// The mate edge of an odd triangle that is cut instead of flipped: nothing lies beyond it, it is
/// locked, or its triangles are far from halves of a parallelogram (k_least_flip_fraction). The
/// last depends on the rest shape alone, so that it is the same whenever it is asked.
bool Sqrt3Mesh::is_cut_in_three(Index e) const {
    const auto [A, B] = edge(e).triangle;
    return B == k_no_index || is_locked(e) ||
           flip_rest(cloth_->rest[at(A)], cloth_->rest[at(B)]).least_fraction <
               k_least_flip_fraction;
}

bool Sqrt3Mesh::waits_for_flip(Index e) const {
    return are_equal_mates(e) && !is_cut_in_three(e);
}

/// A triangle leaves the stars and its old content goes into the log before it is edited.
void Sqrt3Mesh::open(Index t) {
    log_.touch_triangle(*cloth_, t);
    stars_.remove(t, corners(t));
}

/// An edited triangle, or a new one, is whole again.
void Sqrt3Mesh::close(Index t, int generation, const RestTriangle& rest) {
    cloth_->refinement.triangles[at(t)].generation = generation;
    cloth_->rest[at(t)] = rest;
    stars_.add(t, corners(t));
}

/// Room in the arrays beside the mesh for what an edit put at its end.
void Sqrt3Mesh::make_slots() {
    Refinement& refinement = cloth_->refinement;
    cloth_->rest.resize(cloth_->triangles.size());
    refinement.triangles.resize(cloth_->triangles.size());
    refinement.locked.resize(cloth_->topology.edges.size(), 0);
}

Index Sqrt3Mesh::add_vertex(const VertexParents& place, InsertedVertex record) {
    Refinement& refinement = cloth_->refinement;
    const Index parent = place.parents[0];
    record.anchor = refinement.is_inserted(parent) ? refinement.inserted(parent).anchor : parent;
    record.born = limits_.adaptation;
    Vec2 material = Vec2::Zero();
    for (std::size_t k = 0; k < 3 && place.parents[k] != k_no_index; ++k) {
        material += place.weights[k] * cloth_->material_positions[at(place.parents[k])];
    }
    assert(place.vertex == cloth_->vertex_count);
    refinement.vertices.push_back(record);
    cloth_->material_positions.push_back(material);
    cloth_->rest_areas.push_back(0.0);
    return cloth_->vertex_count++;
}

/// Rest shape of t as an odd triangle of that generation, from what it was cut from.
RestTriangle Sqrt3Mesh::odd_rest(Index t, int generation) const {
    const Refinement& refinement = cloth_->refinement;
    const InsertedVertex& apex = refinement.inserted(corners(t)[0]);
    assert(apex.generation == generation);
    if (apex.insertion == Insertion::Centre) {
        return split_rest(parent_rest(apex), part(t, generation));
    }
    // (v1, P, a) or (v2, b, P). v1 keeps what was cut on side 0 of the edge, v2 on side 1.
    const std::uint32_t own = part(t, generation);
    const bool is_near = (apex.insertion == Insertion::EdgeFirst) == (own == 1);
    const bool is_own_record = is_near == (apex.insertion == Insertion::EdgeFirst);
    return trisect_rest(parent_rest(is_own_record ? apex : refinement.inserted(apex.partner)), own);
}

// The end of an adaptation: no gaps, rest areas, what changed.

namespace {

/// Fills dead slots of an array of `count` with its last ones, the lowest first: move(from, to).
/// Returns how many slots are left.
template <typename Move> Index fill(std::vector<Index>& dead, std::size_t count, const Move& move) {
    std::sort(dead.begin(), dead.end());
    auto left = static_cast<Index>(count);
    for (std::size_t first = 0; first < dead.size();) {
        --left;
        if (dead.back() == left) {
            dead.pop_back();
        } else {
            move(left, dead[first++]);
        }
    }
    dead.clear();
    return left;
}

} // namespace

ClothChanges Sqrt3Mesh::finish() {
    assert(cloth_ != nullptr);
    fill_gaps();
    keep_waiting_flips();
    ClothChanges changes = log_.changes(*cloth_);
    set_rest_areas(changes);
#ifndef EIGEN_NO_DEBUG
    assert(check_refinement(*cloth_).empty());
#endif
    cloth_ = nullptr;
    hooks_ = {};
    return changes;
}

void Sqrt3Mesh::fill_gaps() {
    Refinement& refinement = cloth_->refinement;
    cloth_->vertex_count = fill(dead_vertices_, at(cloth_->vertex_count),
                                [&](Index from, Index to) { move_vertex(from, to); });
    cloth_->material_positions.resize(at(cloth_->vertex_count));
    cloth_->rest_areas.resize(at(cloth_->vertex_count));
    refinement.vertices.resize(at(cloth_->vertex_count - refinement.base_vertices));

    const Index edges = fill(dead_edges_, cloth_->topology.edges.size(), [&](Index from, Index to) {
        move_edge(mesh(), from, to);
        refinement.locked[at(to)] = refinement.locked[at(from)];
        if (are_equal_mates(to)) {
            refinement.pending_flips.push_back(to); // under its new name
        }
    });
    cloth_->topology.edges.resize(at(edges));
    refinement.locked.resize(at(edges));

    const Index triangles =
        fill(dead_triangles_, cloth_->triangles.size(), [&](Index from, Index to) {
            open(from);
            move_triangle(mesh(), from, to);
            refinement.triangles[at(to)] = refinement.triangles[at(from)];
            close(to, generation(to), cloth_->rest[at(from)]);
        });
    cloth_->triangles.resize(at(triangles));
    cloth_->topology.triangle_edges.resize(at(triangles));
    cloth_->rest.resize(at(triangles));
    refinement.triangles.resize(at(triangles));
    assert(triangles >= refinement.base_triangles && edges >= refinement.base_edges);
}

void Sqrt3Mesh::move_vertex(Index from, Index to) {
    Refinement& refinement = cloth_->refinement;
    assert(refinement.is_inserted(to));
    stars_.triangles_of(from, star_);
    for (const Index t : star_) {
        open(t);
    }
    rename_vertex(mesh(), star_, from, to);
    for (const Index t : star_) {
        stars_.add(t, corners(t));
    }
    const InsertedVertex& record = refinement.inserted(from);
    if (record.partner != k_no_index) {
        refinement.vertices[at(record.partner - refinement.base_vertices)].partner = to;
    }
    refinement.vertices[at(to - refinement.base_vertices)] = record;
    cloth_->material_positions[at(to)] = cloth_->material_positions[at(from)];
    log_.move_vertex(from, to);
    if (hooks_.move) {
        hooks_.move(from, to);
    }
}

/// Keeps of the pending flips those whose edge is there and still waits: ascending, each once.
void Sqrt3Mesh::keep_waiting_flips() {
    std::vector<Index>& pending = cloth_->refinement.pending_flips;
    std::erase_if(pending, [&](Index e) {
        return at(e) >= cloth_->topology.edges.size() || !waits_for_flip(e);
    });
    std::sort(pending.begin(), pending.end());
    pending.erase(std::unique(pending.begin(), pending.end()), pending.end());
}

/// Sums the corner areas around each vertex whose triangles changed, by ascending triangle slot, as
/// for a cloth just built.
void Sqrt3Mesh::set_rest_areas(ClothChanges& changes) {
    auto moved = changes.vertices.begin();
    for (const Index v : log_.touched_vertices(*cloth_)) {
        double area = 0.0;
        stars_.triangles_of(v, star_);
        for (const Index t : star_) {
            const auto areas = mixed_corner_areas(rest_corners(cloth_->rest[at(t)]));
            for (std::size_t k = 0; k < 3; ++k) {
                area += corners(t)[k] == v ? areas[k] : 0.0;
            }
        }
        const bool is_moved = moved != changes.vertices.end() && moved->slot == v;
        if (is_moved || area != cloth_->rest_areas[at(v)]) {
            changes.masses.push_back(v);
        }
        moved += is_moved ? 1 : 0;
        cloth_->rest_areas[at(v)] = area;
    }
    assert(moved == changes.vertices.end());
}

} // namespace weft
