#include "adapt/refinement_check.h"
#include "adapt/sqrt3_mesh.h"
#include "geometry/mixed_areas.h"

#include <algorithm>
#include <cassert>

// The end of an adaptation: no gaps, rest areas, what changed.

namespace weft {

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

/// Of the edges noted, those that are there and still wait: ascending, each once.
void Sqrt3Mesh::keep_waiting_flips() {
    std::vector<Index>& pending = cloth_->refinement.pending_flips;
    std::erase_if(pending, [&](Index e) {
        return at(e) >= cloth_->topology.edges.size() || !waits_for_flip(e);
    });
    std::sort(pending.begin(), pending.end());
    pending.erase(std::unique(pending.begin(), pending.end()), pending.end());
}

/// Sums the shares around each vertex whose triangles changed, by ascending triangle slot, as for a
/// cloth just built.
void Sqrt3Mesh::set_rest_areas(ClothChanges& changes) {
    auto moved = changes.vertices.begin();
    for (const Index v : log_.touched_vertices(*cloth_)) {
        double area = 0.0;
        stars_.triangles_of(v, star_);
        for (const Index t : star_) {
            const auto shares = mixed_corner_areas(rest_corners(cloth_->rest[at(t)]));
            for (std::size_t k = 0; k < 3; ++k) {
                area += corners(t)[k] == v ? shares[k] : 0.0;
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
