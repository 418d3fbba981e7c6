#include "collide/broad_phase.h"
#include "state/obstacle.h"
#include "support/contact_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace weft {

namespace {

using Key = std::array<Index, 5>; // kind, then the vertices, each side sorted

Key key_of(PairKind kind, std::array<Index, 4> v) {
    if (kind == PairKind::VertexFace) {
        std::sort(v.begin() + 1, v.end());
        return {0, v[0], v[1], v[2], v[3]};
    }
    if (v[0] > v[1]) {
        std::swap(v[0], v[1]);
    }
    if (v[2] > v[3]) {
        std::swap(v[2], v[3]);
    }
    if (v[0] > v[2]) {
        std::swap(v[0], v[2]);
        std::swap(v[1], v[3]);
    }
    return {1, v[0], v[1], v[2], v[3]};
}

/// Two crumpled sheets over a sphere, all moving.
struct Crumpled {
    World world;
    ContactSurface surface;

    Crumpled() {
        FabricParams fabric;
        fabric.thickness = 5e-3;
        test::add_sheet(world, 5, 0.3, 0.1, fabric);
        test::add_sheet(world, 4, 0.3, 0.12, fabric);
        test::add_sphere(world, 0.1, Vec3::Zero(), 1).params.motion = {
            {.t = 0.0}, {.t = 1.0, .translate = {0.3, 2.0, 0.0}}};
        std::mt19937 engine(9);
        std::uniform_real_distribution<double> unit(-1.0, 1.0);
        std::vector<Vec3> velocities;
        for (Vec3& x : world.positions) {
            x += 0.03 * Vec3(unit(engine), unit(engine), unit(engine));
            velocities.push_back(Vec3(1.0, -3.0, 0.0) +
                                 Vec3(unit(engine), unit(engine), unit(engine)));
        }
        surface = make_surface(world);
        place_surface(surface, world, velocities, std::vector<char>(velocities.size(), 0), k_dt);
    }

    static constexpr double k_dt = 0.01;
};

/// Least distance of a pair over the substep, sampled.
double least_distance(const ContactSurface& surface, PairKind kind, const std::array<Index, 4>& v) {
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 20; ++k) {
        PairPoints x;
        for (std::size_t i = 0; i < 4; ++i) {
            const auto vertex = static_cast<std::size_t>(v[i]);
            x[i] = surface.start[vertex] + Crumpled::k_dt * k / 20.0 * surface.velocity[vertex];
        }
        least = std::min(least, separation(kind, x).distance);
    }
    return least;
}

/// All pairs without a common vertex and with a deformable that come nearer than their thickness.
std::set<Key> brute_force(const ContactSurface& surface) {
    std::set<Key> near;
    const auto consider = [&](PairKind kind, const std::array<Index, 4>& v) {
        const std::set<Index> different(v.begin(), v.end());
        const bool has_deformable =
            std::any_of(v.begin(), v.end(), [&](Index i) { return surface.is_deformable(i); });
        const double thickness = surface.thickness_of(v, kind);
        if (different.size() == 4 && has_deformable &&
            least_distance(surface, kind, v) < thickness) {
            near.insert(key_of(kind, v));
        }
    };
    for (const Triangle& t : surface.triangles) {
        for (Index v = 0; v < static_cast<Index>(surface.start.size()); ++v) {
            consider(PairKind::VertexFace, {v, t[0], t[1], t[2]});
        }
    }
    const EdgeTopology topology = build_edges(surface.triangles);
    for (const MeshEdge& a : topology.edges) {
        for (const MeshEdge& b : topology.edges) {
            consider(PairKind::EdgeEdge, {a.v[0], a.v[1], b.v[0], b.v[1]});
        }
    }
    return near;
}

} // namespace

TEST(BroadPhase, MissesNoPairThatComesNear) {
    const Crumpled crumpled;
    BroadPhase broad_phase(crumpled.surface, true);
    std::vector<Candidate> candidates;

    broad_phase.find(crumpled.surface, Crumpled::k_dt, candidates);

    std::set<Key> found;
    for (const Candidate& candidate : candidates) {
        EXPECT_TRUE(found.insert(key_of(candidate.kind, candidate.vertices)).second);
    }
    const std::set<Key> near = brute_force(crumpled.surface);
    EXPECT_GT(near.size(), 100U);
    EXPECT_TRUE(std::includes(found.begin(), found.end(), near.begin(), near.end()));
}

TEST(BroadPhase, CoversSmallChangesAndNoLargeOnes) {
    Crumpled crumpled;
    BroadPhase broad_phase(crumpled.surface, true);
    std::vector<Candidate> candidates;
    broad_phase.find(crumpled.surface, Crumpled::k_dt, candidates);

    EXPECT_TRUE(broad_phase.covers(crumpled.surface, Crumpled::k_dt));
    crumpled.surface.velocity[3].x() += 0.2; // 2 mm of 5 mm thickness
    EXPECT_TRUE(broad_phase.covers(crumpled.surface, Crumpled::k_dt));
    crumpled.surface.velocity[3].x() += 1.0;
    EXPECT_FALSE(broad_phase.covers(crumpled.surface, Crumpled::k_dt));
}

TEST(BroadPhase, WithoutSelfContactLeavesClothToItself) {
    const Crumpled crumpled;
    BroadPhase broad_phase(crumpled.surface, false);
    std::vector<Candidate> candidates;

    broad_phase.find(crumpled.surface, Crumpled::k_dt, candidates);

    EXPECT_FALSE(candidates.empty());
    for (const Candidate& candidate : candidates) {
        EXPECT_NE(crumpled.surface.is_deformable(candidate.vertices[0]),
                  crumpled.surface.is_deformable(candidate.vertices[3]));
    }
}

TEST(BroadPhase, FollowsAnObstacleThatDeforms) {
    World world;
    test::add_sheet(world, 5, 0.3, 0.5, {});
    Obstacle& ball = test::add_sphere(world, 0.1, Vec3::Zero(), 1);
    const std::vector<Vec3> rest = ball.mesh.positions;
    ball.deformation =
        std::make_shared<Deformation>(rest.size(), 0, [rest](double t, std::span<Vec3> positions) {
            for (std::size_t i = 0; i < rest.size(); ++i) {
                positions[i] = (1.0 + std::max(0.0, t - 1.0)) * rest[i]; // reaches y = 0.5 at t = 5
            }
        });
    ContactSurface surface = make_surface(world);
    BroadPhase broad_phase(surface, false);
    const std::vector<Vec3> velocities(world.vertex_count(), Vec3::Zero());
    const std::vector<char> held(world.vertex_count(), 0);
    std::vector<Candidate> candidates;
    const auto find_at = [&](double t) {
        world.time = t;
        place_surface(surface, world, velocities, held, 0.5);
        broad_phase.find(surface, 0.5, candidates);
        return candidates.size();
    };

    EXPECT_EQ(find_at(0.0), 0u);
    const std::uint64_t number = surface.objects[1].motion_number;
    EXPECT_EQ(find_at(0.5), 0u);
    EXPECT_EQ(surface.objects[1].motion_number, number); // at rest: nothing to fit anew
    EXPECT_GT(find_at(4.75), 0u);
}

} // namespace weft
