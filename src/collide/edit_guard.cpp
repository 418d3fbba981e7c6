#include "collide/edit_guard.h"

#include "geometry/crossing.h"
#include "geometry/hull_gap.h"

#include <algorithm>

namespace weft {

namespace {

/// Gap that an edit must leave, as a fraction of the wanted distance: impacts leave as much.
constexpr double k_least_fraction = 0.3;

template <std::size_t N> Box box_of(const std::array<Vec3, N>& points, double margin) {
    Box box = segment_box(points[0], points[1], margin);
    for (std::size_t k = 2; k < N; ++k) {
        box = unite(box, segment_box(points[k], points[k], margin));
    }
    return box;
}

std::array<Vec3, 3> places(const Triangle& t, std::span<const Vec3> positions) {
    return {positions[at(t[0])], positions[at(t[1])], positions[at(t[2])]};
}

/// A triangle whose vertices are named by their numbers on the surface before the edits; new
/// vertices have names of their own.
struct Named {
    Triangle names;
    std::array<Vec3, 3> x;
};

Named name(const Triangle& triangle,
           std::span<const Vec3> positions,
           const ClothChanges& changes,
           Index first_vertex) {
    Named named{triangle, places(triangle, positions)};
    for (Index& v : named.names) {
        const auto moved = std::lower_bound(
            changes.vertices.begin(), changes.vertices.end(), v,
            [](const ClothChanges::Vertex& one, Index slot) { return one.slot < slot; });
        if (moved == changes.vertices.end() || moved->slot != v) {
            v += first_vertex;
        } else if (moved->from != k_no_index) {
            v = first_vertex + moved->from;
        } else {
            v = k_no_index - 1 - v;
        }
    }
    return named;
}

bool cross(const Named& s, const Named& t) {
    const std::array<Vec3, 6> x{s.x[0], s.x[1], s.x[2], t.x[0], t.x[1], t.x[2]};
    constexpr Triangle first{0, 1, 2};
    Triangle second{3, 4, 5};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            second[j] = s.names[i] == t.names[j] ? first[i] : second[j]; // a shared corner is one
        }
    }
    return triangles_cross(first, second, x);
}

} // namespace

bool EditGuard::is_clear_of(Index triangle,
                            Index object,
                            const std::array<Vec3, 4>& corners,
                            const std::array<Index, 4>& vertices) const {
    const ContactObject& own = surface_.objects[at(object)];
    const Triangle& t = surface_.triangles[at(triangle)];
    const Index other = surface_.object_of_vertex[at(t[0])];
    double wanted = surface_.rules[at(object) * surface_.objects.size() + at(other)].thickness;
    for (const Index v : vertices) {
        if (v < own.vertex_count && surface_.has_corner(t, own.first_vertex + v)) {
            return true;
        }
        if (v < own.vertex_count && surface_.is_deformable(t[0])) {
            wanted = std::min(wanted, surface_.self_thickness[at(own.first_vertex + v)]);
        }
    }
    for (const Index v : t) {
        if (surface_.is_deformable(v)) {
            wanted = std::min(wanted, surface_.self_thickness[at(v)]);
        }
    }
    return hull_gap(corners, {ends_[at(t[0])], ends_[at(t[1])], ends_[at(t[2])]}) >
           k_least_fraction * wanted;
}

/// Edits at a common vertex may overlap here: crosses() tests them together at the end.
bool EditGuard::is_clear_of_edits(Index object,
                                  const Box& box,
                                  const std::array<Index, 4>& vertices) const {
    return std::none_of(swept_.begin(), swept_.end(), [&](const Swept& swept) {
        const auto are_neighbours = [&] {
            return swept.object == object &&
                   std::any_of(vertices.begin(), vertices.end(), [&](Index v) {
                       return std::find(swept.vertices.begin(), swept.vertices.end(), v) !=
                              swept.vertices.end();
                   });
        };
        return overlap(box, swept.box) && !are_neighbours();
    });
}

bool EditGuard::may_sweep(Index cloth,
                          const std::array<Vec3, 4>& corners,
                          const std::array<Index, 4>& vertices) {
    const Index object = surface_.number_of({ObjectKind::Cloth, cloth});
    const Box box = box_of(corners, k_least_fraction * surface_.objects[at(object)].thickness);
    bool is_clear = is_clear_of_edits(object, box, vertices);
    if (is_clear) {
        broad_phase_.for_each_near(surface_, box, [&](Index triangle) {
            is_clear = is_clear && is_clear_of(triangle, object, corners, vertices);
        });
    }
    if (is_clear) {
        swept_.push_back({object, box, vertices});
    }
    return is_clear;
}

bool EditGuard::crosses(Index index,
                        const Cloth& cloth,
                        std::span<const Vec3> positions,
                        const ClothChanges& changes) const {
    const ContactObject& own = surface_.objects[at(surface_.number_of({ObjectKind::Cloth, index}))];
    std::vector<Named> named;
    std::vector<Box> boxes;
    for (const Index t : changes.triangles) {
        named.push_back(name(cloth.triangles[at(t)], positions, changes, own.first_vertex));
        boxes.push_back(box_of(named.back().x, 0.0));
    }
    std::vector<char> is_gone(at(own.triangle_count), 0);
    for (std::size_t t = cloth.triangles.size(); t < is_gone.size(); ++t) {
        is_gone[t] = 1;
    }
    for (const Index t : changes.triangles) {
        if (t < own.triangle_count) {
            is_gone[at(t)] = 1;
        }
    }
    const BoxTree tree(boxes);
    bool found = false;
    broad_phase_.for_each_near(surface_, tree, [&](Index i, Index other) {
        const Triangle& t = surface_.triangles[at(other)];
        const Index of_own = other - own.first_triangle;
        if (found || (of_own >= 0 && of_own < own.triangle_count && is_gone[at(of_own)] != 0)) {
            return;
        }
        const Named still{t, places(t, ends_)};
        // the tree's boxes hold its whole way, and more
        found = overlap(boxes[at(i)], box_of(still.x, 0.0)) && cross(named[at(i)], still);
    });
    if (!tree.empty() && broad_phase_.looks_at_self()) {
        BoxTree::overlaps(tree, tree, {0, 0}, [&](Index i, Index j) {
            found = found || cross(named[at(i)], named[at(j)]);
        });
    }
    return found;
}

} // namespace weft
