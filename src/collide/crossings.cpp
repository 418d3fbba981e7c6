#include "collide/crossings.h"

#include "base/parallel.h"
#include "geometry/crossing.h"

#include <cassert>

namespace weft {

namespace {

constexpr std::size_t k_tasks = 128;

SharedCorners shared_corners(const ContactSurface& surface, const Triangle& s, const Triangle& t) {
    SharedCorners shared;
    for (std::size_t k = 0; k < 3 && !surface.joined_begin.empty(); ++k) {
        shared.s[k] = surface.has_corner(t, s[k]);
        shared.t[k] = surface.has_corner(s, t[k]);
    }
    return shared;
}

} // namespace

bool triangles_cross(const ContactSurface& surface,
                     Index s,
                     Index t,
                     std::span<const Vec3> positions) {
    const Triangle& one = surface.triangles[at(s)];
    const Triangle& two = surface.triangles[at(t)];
    return triangles_cross(one, two, positions, shared_corners(surface, one, two));
}

CrossingSearch::CrossingSearch(const ContactSurface& surface, bool self)
    : self_(self), boxes_(surface.triangles.size()) {}

std::vector<TrianglePair> CrossingSearch::find(const ContactSurface& surface,
                                               std::span<const Vec3> positions) {
    assert(positions.size() == surface.start.size());
    parallel_for(surface.triangles.size(), [&](std::size_t i) {
        const Triangle& t = surface.triangles[i];
        const Vec3& c = positions[at(t[2])];
        boxes_[i] = unite(segment_box(positions[at(t[0])], positions[at(t[1])], 0.0),
                          segment_box(c, c, 0.0));
    });
    const Index split = surface.deformable_triangles;
    const auto fit = [](BoxTree& tree, std::span<const Box> boxes) {
        if (tree.empty()) {
            tree = BoxTree(boxes);
        } else {
            tree.refit(boxes);
        }
    };
    fit(deformables_, std::span(boxes_).first(at(split)));
    fit(obstacles_, std::span(boxes_).subspan(at(split)));
    std::vector<TrianglePair> crossings;
    const auto gather = [&](const BoxTree& a, const BoxTree& b, Index first_b) {
        BoxTree::split(a, b, k_tasks, tasks_);
        parallel_collect(
            tasks_.size(),
            [&](std::size_t i, auto& found) {
                BoxTree::overlaps(a, b, tasks_[i], [&](Index s, Index t) {
                    const Index other = first_b + t;
                    if (!surface.is_off(s, other) &&
                        triangles_cross(surface, s, other, positions)) {
                        found.push_back({std::min(s, other), std::max(s, other)});
                    }
                });
            },
            tasks_found_, crossings, 1);
    };
    if (self_) {
        gather(deformables_, deformables_, 0);
    }
    gather(deformables_, obstacles_, split);
    std::sort(crossings.begin(), crossings.end());
    return crossings;
}

WorldCrossings::WorldCrossings(const World& world, bool self)
    : self_(self), mesh_revisions_(mesh_revisions(world)),
      surface_(make_surface(world, {.self = self})),
      search_(surface_, self || !surface_.bodies.empty()) {}

std::vector<UnresolvedPair> WorldCrossings::find(const World& world, double time) {
    if (mesh_revisions_ != mesh_revisions(world)) {
        *this = WorldCrossings(world, self_);
    }
    std::copy(world.positions.begin(), world.positions.end(), surface_.start.begin());
    std::size_t next = world.vertex_count();
    for (const Obstacle& obstacle : world.obstacles) {
        const std::size_t count = obstacle.mesh.positions.size();
        obstacle_positions(obstacle, time, std::span(surface_.start).subspan(next, count));
        next += count;
    }
    join_seams(surface_, world);
    std::vector<UnresolvedPair> crossings;
    for (const auto& pair : search_.find(surface_, surface_.start)) {
        crossings.push_back(describe_crossing(surface_, surface_.start, pair));
    }
    return crossings;
}

std::vector<UnresolvedPair> find_crossings(const World& world, std::size_t limit) {
    std::vector<UnresolvedPair> pairs = WorldCrossings(world, true).find(world, world.time);
    pairs.resize(std::min(pairs.size(), limit));
    return pairs;
}

} // namespace weft
