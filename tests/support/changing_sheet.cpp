#include "support/changing_sheet.h"

#include "support/sheets.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace weft::test {

namespace {

bool same(const RestTriangle& a, const RestTriangle& b) {
    return a.inverse_edges == b.inverse_edges && a.area == b.area;
}

bool same(const MeshEdge& a, const MeshEdge& b) {
    return a.v == b.v && a.triangle == b.triangle && a.apex == b.apex;
}

template <typename T> bool same(const T& a, const T& b) {
    return a == b;
}

template <typename T>
std::vector<Index> different_slots(const std::vector<T>& a, const std::vector<T>& b) {
    std::vector<Index> slots;
    for (std::size_t i = 0; i < b.size(); ++i) {
        if (i >= a.size() || !same(a[i], b[i])) {
            slots.push_back(static_cast<Index>(i));
        }
    }
    return slots;
}

double doubled_area(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// Gives edges that were there before their old slots, new ones those left, and closes the gaps.
void keep_edge_slots(const EdgeTopology& old_edges,
                     std::span<const Index> old_ids,
                     EdgeTopology& edges,
                     std::span<const Index> ids) {
    using Ends = std::pair<Index, Index>;
    const auto ends = [](const MeshEdge& edge, std::span<const Index> by_vertex) {
        const Index a = by_vertex[at(edge.v[0])];
        const Index b = by_vertex[at(edge.v[1])];
        return Ends(std::min(a, b), std::max(a, b));
    };
    std::vector<std::pair<Ends, std::size_t>> old_slots;
    for (std::size_t e = 0; e < old_edges.edges.size(); ++e) {
        old_slots.emplace_back(ends(old_edges.edges[e], old_ids), e);
    }
    std::sort(old_slots.begin(), old_slots.end());
    const std::size_t count = edges.edges.size();
    std::vector<std::size_t> slot_of(count, count);
    std::vector<char> is_taken(count, 0);
    for (std::size_t e = 0; e < count; ++e) {
        const std::pair<Ends, std::size_t> key(ends(edges.edges[e], ids), 0);
        const auto found = std::lower_bound(old_slots.begin(), old_slots.end(), key);
        if (found != old_slots.end() && found->first == key.first && found->second < count) {
            slot_of[e] = found->second;
            is_taken[found->second] = 1;
        }
    }
    std::size_t gap = 0;
    EdgeTopology sorted = edges;
    for (std::size_t e = 0; e < count; ++e) {
        if (slot_of[e] == count) {
            while (is_taken[gap] != 0) {
                ++gap;
            }
            slot_of[e] = gap++;
        }
        sorted.edges[slot_of[e]] = edges.edges[e];
    }
    for (auto& sides : sorted.triangle_edges) {
        for (Index& e : sides) {
            e = static_cast<Index>(slot_of[at(e)]);
        }
    }
    edges = std::move(sorted);
}

} // namespace

ClothChanges diff_cloths(const Cloth& old_cloth,
                         std::span<const Index> old_ids,
                         const Cloth& new_cloth,
                         std::span<const Index> new_ids) {
    ClothChanges changes;
    std::map<Index, Index> old_slot;
    for (std::size_t v = 0; v < old_ids.size(); ++v) {
        old_slot[old_ids[v]] = static_cast<Index>(v);
    }
    changes.masses = different_slots(old_cloth.rest_areas, new_cloth.rest_areas);
    for (std::size_t v = 0; v < new_ids.size(); ++v) {
        if (v >= old_ids.size() || old_ids[v] != new_ids[v]) {
            const auto found = old_slot.find(new_ids[v]);
            changes.vertices.push_back(
                {static_cast<Index>(v), found == old_slot.end() ? k_no_index : found->second});
            changes.masses.push_back(static_cast<Index>(v));
        }
    }
    std::sort(changes.masses.begin(), changes.masses.end());
    changes.masses.erase(std::unique(changes.masses.begin(), changes.masses.end()),
                         changes.masses.end());
    changes.triangles = different_slots(old_cloth.triangles, new_cloth.triangles);
    const std::vector<Index> rest = different_slots(old_cloth.rest, new_cloth.rest);
    changes.triangles.insert(changes.triangles.end(), rest.begin(), rest.end());
    std::sort(changes.triangles.begin(), changes.triangles.end());
    changes.triangles.erase(std::unique(changes.triangles.begin(), changes.triangles.end()),
                            changes.triangles.end());
    changes.edges = different_slots(old_cloth.topology.edges, new_cloth.topology.edges);
    return changes;
}

ChangingSheet::ChangingSheet(Sheet sheet,
                             const FabricParams& fabric,
                             BendModel bend_model,
                             unsigned seed)
    : random_(seed), sheet_(std::move(sheet)), next_id_(static_cast<Index>(sheet_.points.size())),
      cloth_(cloth_of(sheet_, fabric, bend_model)) {
    for (Index i = 0; i < next_id_; ++i) {
        ids_.push_back(i);
    }
    rebuild_cloth();
}

ClothChanges ChangingSheet::change(int edits, double growth, double window) {
    const Cloth old_cloth = cloth_;
    const std::vector<Index> old_ids = ids_;
    is_used_.assign(sheet_.triangles.size(), 0);
    valence_.assign(sheet_.points.size(), 0);
    for (const Triangle& t : sheet_.triangles) {
        for (const Index v : t) {
            ++valence_[at(v)];
        }
    }
    for (const MeshEdge& edge : cloth_.topology.edges) {
        if (edge.is_boundary()) {
            valence_[at(edge.v[0])] = valence_[at(edge.v[1])] = 0;
        }
    }
    const auto triangles =
        static_cast<std::size_t>(std::ceil(window * static_cast<double>(sheet_.triangles.size())));
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < edits; ++i) {
        const std::size_t t = random_() % triangles;
        const double dice = uniform(random_);
        if (is_used_[t] == 0) {
            if (dice < 0.6 * growth) {
                split(t);
            } else if (dice < 0.6) {
                take_out(t);
            } else {
                flip(t);
            }
        }
    }
    close_gaps();
    rebuild_cloth();
    keep_edge_slots(old_cloth.topology, old_ids, cloth_.topology, ids_);
    return diff_cloths(old_cloth, old_ids, cloth_, ids_);
}

void ChangingSheet::split(std::size_t t) {
    const auto [a, b, c] = sheet_.triangles[t];
    const Index p =
        new_vertex((sheet_.points[at(a)] + sheet_.points[at(b)] + sheet_.points[at(c)]) / 3.0);
    sheet_.triangles[t] = {p, a, b};
    is_used_[t] = 1;
    new_triangle({p, b, c});
    new_triangle({p, c, a});
}

void ChangingSheet::flip(std::size_t t) {
    const auto side = cloth_.topology.triangle_edges[t][random_() % 3];
    const MeshEdge& edge = cloth_.topology.edges[at(side)];
    if (edge.is_boundary()) {
        return;
    }
    const auto& p = sheet_.points;
    const auto [a, b] = edge.v;
    const auto [c, d] = edge.apex;
    const std::size_t t0 = at(edge.triangle[0]);
    const std::size_t t1 = at(edge.triangle[1]);
    const double scale = doubled_area(p[at(a)], p[at(b)], p[at(c)]);
    const bool is_convex = doubled_area(p[at(a)], p[at(d)], p[at(c)]) > 0.1 * scale &&
                           doubled_area(p[at(d)], p[at(b)], p[at(c)]) > 0.1 * scale;
    if (is_used_[t0] != 0 || is_used_[t1] != 0 || !is_convex) {
        return;
    }
    sheet_.triangles[t0] = {a, d, c};
    sheet_.triangles[t1] = {d, b, c};
    is_used_[t0] = is_used_[t1] = 1;
}

/// Takes out a corner of t that has three triangles.
void ChangingSheet::take_out(std::size_t t) {
    for (std::size_t k = 0; k < 3; ++k) {
        const Index p = cloth_.triangles[t][k];
        if (valence_[at(p)] != 3) {
            continue;
        }
        const Index a = cloth_.triangles[t][(k + 1) % 3];
        const Index b = cloth_.triangles[t][(k + 2) % 3];
        const auto across = [&](std::size_t corner) {
            const Index side = cloth_.topology.triangle_edges[t][corner];
            const MeshEdge& edge = cloth_.topology.edges[at(side)];
            const std::size_t other = edge.triangle[0] == static_cast<Index>(t) ? 1 : 0;
            return std::pair(at(edge.triangle[other]), edge.apex[other]);
        };
        const auto [t1, c] = across((k + 1) % 3);
        const auto [t2, same] = across((k + 2) % 3);
        if (is_used_[t1] != 0 || is_used_[t2] != 0) {
            continue;
        }
        sheet_.triangles[t] = {a, b, c};
        is_used_[t] = is_used_[t1] = is_used_[t2] = 1;
        free_triangles_.insert(free_triangles_.end(), {t1, t2});
        removed_.push_back(p);
        return;
    }
}

Index ChangingSheet::new_vertex(const Vec2& point) {
    Index v = static_cast<Index>(sheet_.points.size());
    if (!removed_.empty()) {
        v = removed_.back();
        removed_.pop_back();
        sheet_.points[at(v)] = point;
        ids_[at(v)] = next_id_++;
        return v;
    }
    sheet_.points.push_back(point);
    ids_.push_back(next_id_++);
    return v;
}

std::size_t ChangingSheet::new_triangle(const Triangle& corners) {
    if (!free_triangles_.empty()) {
        const std::size_t t = free_triangles_.back();
        free_triangles_.pop_back();
        sheet_.triangles[t] = corners;
        return t;
    }
    sheet_.triangles.push_back(corners);
    return sheet_.triangles.size() - 1;
}

/// Moves what stands last into the gaps.
void ChangingSheet::close_gaps() {
    std::sort(free_triangles_.rbegin(), free_triangles_.rend());
    for (const std::size_t gap : free_triangles_) {
        sheet_.triangles[gap] = sheet_.triangles.back();
        sheet_.triangles.pop_back();
    }
    free_triangles_.clear();
    std::vector<Index> slot_of(sheet_.points.size());
    for (std::size_t v = 0; v < slot_of.size(); ++v) {
        slot_of[v] = static_cast<Index>(v);
    }
    std::sort(removed_.rbegin(), removed_.rend());
    std::vector<Index> vertex_at = slot_of;
    for (const Index gap : removed_) {
        const std::size_t last = sheet_.points.size() - 1;
        sheet_.points[at(gap)] = sheet_.points[last];
        ids_[at(gap)] = ids_[last];
        vertex_at[at(gap)] = vertex_at[last];
        slot_of[at(vertex_at[last])] = gap;
        sheet_.points.pop_back();
        ids_.pop_back();
    }
    removed_.clear();
    for (Triangle& t : sheet_.triangles) {
        for (Index& v : t) {
            v = slot_of[at(v)];
        }
    }
}

void ChangingSheet::rebuild_cloth() {
    const Index first_vertex = cloth_.first_vertex;
    cloth_ = cloth_of(sheet_, cloth_.params.fabric, cloth_.params.bend_model);
    cloth_.first_vertex = first_vertex;
}

} // namespace weft::test
