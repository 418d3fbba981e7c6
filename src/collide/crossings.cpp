#include "collide/crossings.h"

#include "base/parallel.h"
#include "collide/contact.h"
#include "geometry/crossing.h"
#include "state/world_objects.h"

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

ContactProblem describe_crossing(const ContactSurface& surface,
                                 std::span<const Vec3> x,
                                 const std::array<Index, 2>& pair) {
    ContactProblem crossing{
        .objects{},
        .triangles{},
        .place = crossing_place(surface.triangles[at(pair[0])], surface.triangles[at(pair[1])], x)};
    for (std::size_t side = 0; side < 2; ++side) {
        const Index object = surface.object_of_vertex[at(surface.triangles[at(pair[side])][0])];
        crossing.objects[side] = object;
        crossing.triangles[side] = pair[side] - surface.objects[at(object)].first_triangle;
    }
    return crossing;
}

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

std::vector<std::array<Index, 2>> CrossingSearch::find(const ContactSurface& surface,
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
    std::vector<std::array<Index, 2>> crossings;
    const auto gather = [&](const BoxTree& a, const BoxTree& b, Index first_b) {
        BoxTree::split(a, b, k_tasks, tasks_);
        found_.resize(std::max(found_.size(), tasks_.size()));
        parallel_for(
            tasks_.size(),
            [&](std::size_t i) {
                found_[i].clear();
                BoxTree::overlaps(a, b, tasks_[i], [&](Index s, Index t) {
                    const Index other = first_b + t;
                    if (!surface.is_off(s, other) &&
                        triangles_cross(surface, s, other, positions)) {
                        found_[i].push_back({std::min(s, other), std::max(s, other)});
                    }
                });
            },
            1);
        for (std::size_t i = 0; i < tasks_.size(); ++i) {
            crossings.insert(crossings.end(), found_[i].begin(), found_[i].end());
        }
    };
    if (self_) {
        gather(deformables_, deformables_, 0);
    }
    gather(deformables_, obstacles_, split);
    std::sort(crossings.begin(), crossings.end());
    return crossings;
}

WorldCrossings::WorldCrossings(const World& world, bool self)
    : self_(self), adaptations_(adaptations_of(world)),
      surface_(make_surface(world, {.self = self})),
      search_(surface_, self || !surface_.bodies.empty()) {}

std::vector<ContactProblem> WorldCrossings::find(const World& world, double time) {
    if (adaptations_ != adaptations_of(world)) {
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
    std::vector<ContactProblem> crossings;
    for (const auto& pair : search_.find(surface_, surface_.start)) {
        crossings.push_back(describe_crossing(surface_, surface_.start, pair));
    }
    return crossings;
}

std::vector<CrossingPair> find_crossings(const World& world, std::size_t limit) {
    std::vector<CrossingPair> pairs;
    for (const ContactProblem& p : WorldCrossings(world, true).find(world, world.time)) {
        if (pairs.size() == limit) {
            break;
        }
        pairs.push_back({object_name(world, p.objects[0]), object_name(world, p.objects[1]),
                         p.triangles[0], p.triangles[1], p.place});
    }
    return pairs;
}

} // namespace weft
