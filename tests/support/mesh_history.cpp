#include "support/mesh_history.h"

#include "adapt/adaptive_cloth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace weft::test {

namespace {

std::uint64_t mixed(std::uint64_t x) { // splitmix64
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

double total_area(const Cloth& cloth) {
    return std::accumulate(cloth.rest.begin(), cloth.rest.end(), 0.0,
                           [](double sum, const RestTriangle& t) { return sum + t.area; });
}

template <typename Same>
std::vector<Index> slots_that_differ(std::size_t before, std::size_t now, const Same& are_same) {
    std::vector<Index> slots;
    for (std::size_t i = 0; i < now; ++i) {
        if (i >= before || !are_same(i)) {
            slots.push_back(static_cast<Index>(i));
        }
    }
    return slots;
}

} // namespace

MeshHistory::MeshHistory(const Cloth& start, unsigned seed, Index max_level)
    : cloth(start), mesh(cloth), random(seed), max_level_(max_level) {
    for (Index v = 0; v < cloth.vertex_count; ++v) {
        names_.push_back(mixed(static_cast<std::uint64_t>(v)));
    }
}

bool MeshHistory::chance(double share) {
    return std::uniform_real_distribution<double>(0.0, 1.0)(random) < share;
}

MeshHistory::Name MeshHistory::name_of(const VertexParents& place) const {
    Name name = 0;
    for (std::size_t k = 0; k < 3 && place.parents[k] != k_no_index; ++k) {
        const auto weight = static_cast<Name>(std::lround(3.0 * place.weights[k]));
        name += mixed(names_[at(place.parents[k])] + weight);
    }
    return mixed(name);
}

AdaptationHooks MeshHistory::hooks() {
    AdaptationHooks hooks;
    hooks.insert = [&](const VertexParents& place) {
        ASSERT_EQ(at(place.vertex), names_.size());
        names_.push_back(name_of(place));
    };
    hooks.remove = [&](const VertexParents& place) {
        EXPECT_EQ(names_[at(place.vertex)], name_of(place)) << "removed to other parents";
    };
    hooks.move = [&](Index from, Index to) { names_[at(to)] = names_[at(from)]; };
    hooks.may_flip = [&](const EdgeFlip&) { return !chance(refused_); };
    hooks.may_remove = [&](const Removal&) { return !chance(refused_); };
    return hooks;
}

void MeshHistory::begin() {
    before_ = cloth;
    names_before_ = names_;
    mesh.begin(cloth, hooks(), {.max_level = max_level_, .adaptation = ++adaptation_});
}

void MeshHistory::finish() {
    const ClothChanges changes = mesh.finish();
    names_.resize(at(cloth.vertex_count));
    ASSERT_EQ(check_refinement(cloth), "");
    EXPECT_NEAR(total_area(cloth), total_area(before_), 1e-12 * total_area(before_));
    expect_true_changes(changes);
}

void MeshHistory::expect_true_changes(const ClothChanges& changes) const {
    const auto rest_and_corners = [&](std::size_t t) {
        return cloth.triangles[t] == before_.triangles[t] &&
               cloth.rest[t].inverse_edges == before_.rest[t].inverse_edges &&
               cloth.rest[t].area == before_.rest[t].area;
    };
    const auto ends_and_sides = [&](std::size_t e) {
        const MeshEdge& a = cloth.topology.edges[e];
        const MeshEdge& b = before_.topology.edges[e];
        return a.v == b.v && a.triangle == b.triangle && a.apex == b.apex;
    };
    EXPECT_EQ(changes.triangles, slots_that_differ(before_.triangles.size(), cloth.triangles.size(),
                                                   rest_and_corners));
    EXPECT_EQ(changes.edges, slots_that_differ(before_.topology.edges.size(),
                                               cloth.topology.edges.size(), ends_and_sides));
    std::map<Index, Index> from;
    for (const ClothChanges::Vertex& vertex : changes.vertices) {
        EXPECT_TRUE(from.empty() || from.rbegin()->first < vertex.slot);
        from[vertex.slot] = vertex.from;
    }
    std::vector<Index> masses;
    for (Index v = 0; v < cloth.vertex_count; ++v) {
        const Index old = from.count(v) > 0 ? from[v] : v;
        EXPECT_TRUE(old == k_no_index || names_[at(v)] == names_before_.at(at(old)));
        if (from.count(v) > 0 || cloth.rest_areas[at(v)] != before_.rest_areas[at(v)]) {
            masses.push_back(v);
        }
    }
    EXPECT_EQ(changes.masses, masses);
}

void MeshHistory::run(int adaptations, int edits, double share) {
    for (int i = 0; i < adaptations && !testing::Test::HasFailure(); ++i) {
        begin();
        mesh.retry_flips();
        for (int k = 0; k < edits; ++k) {
            const auto any = static_cast<Index>(random() % cloth.triangles.size());
            if (chance(share)) {
                if (!is_dead(cloth.triangles[at(any)])) {
                    mesh.refine(any);
                }
            } else if (const auto v = static_cast<Index>(random() % at(cloth.vertex_count));
                       mesh.can_remove(v)) {
                mesh.remove(v);
            }
        }
        finish();
    }
}

void MeshHistory::refine_all() {
    begin();
    const auto levels = cloth.refinement.triangles;
    for (std::size_t t = 0; t < levels.size(); ++t) {
        if (cloth.refinement.triangles[t].generation == levels[t].generation) {
            mesh.refine(static_cast<Index>(t));
        }
    }
    finish();
}

void MeshHistory::refine_around(const Vec2& place) {
    std::vector<std::pair<double, Index>> by_distance;
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        double distance = 0.0;
        for (const Index v : cloth.triangles[t]) {
            distance += (cloth.material_positions[at(v)] - place).norm();
        }
        by_distance.emplace_back(distance, static_cast<Index>(t));
    }
    std::sort(by_distance.begin(), by_distance.end());
    begin();
    for (std::size_t i = 0; i < std::min<std::size_t>(4, by_distance.size()); ++i) {
        mesh.refine(by_distance[i].second);
    }
    finish();
}

int MeshHistory::finest_level() const {
    int finest = 0;
    for (const TriangleLevel& level : cloth.refinement.triangles) {
        finest = std::max(finest, level_of(level.generation));
    }
    return finest;
}

void MeshHistory::coarsen_all() {
    while (!cloth.refinement.vertices.empty() && !testing::Test::HasFailure()) {
        begin();
        std::vector<Index> order(cloth.refinement.vertices.size());
        std::iota(order.begin(), order.end(), cloth.refinement.base_vertices);
        std::shuffle(order.begin(), order.end(), random);
        for (const Index v : order) {
            if (mesh.can_remove(v)) {
                mesh.remove(v);
            }
        }
        finish();
    }
}

void MeshHistory::retry_flips() {
    begin();
    mesh.retry_flips();
    finish();
}

void MeshHistory::insert(const std::map<Name, int>& wanted) {
    begin();
    for (bool is_changing = true; is_changing;) {
        is_changing = false;
        std::vector<Index> order(cloth.triangles.size());
        std::iota(order.begin(), order.end(), 0);
        std::shuffle(order.begin(), order.end(), random);
        for (const Index t : order) {
            const Triangle corners = cloth.triangles[at(t)];
            VertexParents place{k_no_index, corners, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}};
            if (cloth.refinement.triangles[at(t)].generation % 2 != 0) {
                place.parents = {corners[1], corners[2], k_no_index};
                place.weights = {2.0 / 3.0, 1.0 / 3.0, 0.0};
            }
            if (wanted.count(name_of(place)) > 0) {
                is_changing = mesh.refine(t) || is_changing;
            }
        }
    }
    finish();
}

std::map<MeshHistory::Name, int> MeshHistory::inserted() const {
    std::map<Name, int> names;
    for (Index v = cloth.refinement.base_vertices; v < cloth.vertex_count; ++v) {
        ++names[names_[at(v)]];
    }
    return names;
}

std::map<MeshHistory::Part, int> MeshHistory::content() const {
    std::map<Part, int> content;
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        const Triangle& v = cloth.triangles[t];
        const Mat2& m = cloth.rest[t].inverse_edges;
        ++content[{{names_[at(v[0])], names_[at(v[1])], names_[at(v[2])]},
                   cloth.refinement.triangles[t].generation,
                   {m(0, 0), m(0, 1), m(1, 0), m(1, 1), cloth.rest[t].area}}];
    }
    return content;
}

} // namespace weft::test
