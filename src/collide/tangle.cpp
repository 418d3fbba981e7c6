#include "collide/tangle.h"

#include "base/parallel.h"
#include "collide/crossings.h"

#include <tuple>

namespace weft {

namespace {

constexpr std::size_t k_tasks = 128;

std::vector<Index> triangles_with(const Tangle& tangle, TangleRole role) {
    std::vector<Index> triangles;
    for (std::size_t o = 0; o < tangle.roles.size(); ++o) {
        const ContactObject& object = tangle.surface.objects[o];
        for (Index t = 0; tangle.roles[o] == role && t < object.triangle_count; ++t) {
            triangles.push_back(object.first_triangle + t);
        }
    }
    return triangles;
}

void fit(const Tangle& tangle,
         std::span<const Index> triangles,
         double margin,
         std::vector<Box>& boxes,
         BoxTree& tree) {
    boxes.resize(triangles.size());
    parallel_for(triangles.size(), [&](std::size_t i) {
        const auto c = tangle.corners(triangles[i]);
        boxes[i] = unite(segment_box(c[0], c[1], margin), segment_box(c[2], c[2], margin));
    });
    if (tree.empty()) {
        tree = BoxTree(std::span<const Box>(boxes));
    } else {
        tree.refit(boxes);
    }
}

} // namespace

Tangle make_tangle(const World& world) {
    Tangle tangle;
    tangle.surface = make_surface(world);
    tangle.roles.assign(tangle.surface.objects.size(), TangleRole::Stands);
    tangle.mobility.assign(tangle.surface.start.size(), 0.0);
    tangle.x = world.positions;
    tangle.x.resize(tangle.surface.start.size());
    std::size_t next = world.vertex_count();
    for (const Obstacle& obstacle : world.obstacles) {
        const std::size_t count = obstacle.mesh.positions.size();
        obstacle_positions(obstacle, world.time, std::span(tangle.x).subspan(next, count));
        next += count;
    }
    return tangle;
}

void set_role(Tangle& tangle, std::size_t object, TangleRole role) {
    tangle.roles[object] = role;
    const ContactObject& o = tangle.surface.objects[object];
    std::fill_n(tangle.mobility.begin() + o.first_vertex, o.vertex_count,
                role == TangleRole::Moves ? 1.0 : 0.0);
}

NearPairSearch::NearPairSearch(const Tangle& tangle, bool self)
    : self_(self), moving_(triangles_with(tangle, TangleRole::Moves)),
      standing_(triangles_with(tangle, TangleRole::Stands)) {}

void NearPairSearch::find(const Tangle& tangle, double margin, std::vector<NearPair>& pairs) {
    pairs.clear();
    fit(tangle, moving_, 0.5 * margin, boxes_, moving_tree_);
    if (standing_margin_ != margin) {
        fit(tangle, standing_, 0.5 * margin, boxes_, standing_tree_);
        standing_margin_ = margin;
    }
    if (self_) {
        gather(tangle, moving_tree_, moving_tree_, moving_, pairs);
    }
    gather(tangle, moving_tree_, standing_tree_, standing_, pairs);
    std::sort(pairs.begin(), pairs.end(), [](const NearPair& a, const NearPair& b) {
        return std::tie(a.first, a.second) < std::tie(b.first, b.second);
    });
}

void NearPairSearch::gather(const Tangle& tangle,
                            const BoxTree& a,
                            const BoxTree& b,
                            std::span<const Index> of_b,
                            std::vector<NearPair>& pairs) {
    if (a.empty() || b.empty()) {
        return;
    }
    BoxTree::split(a, b, k_tasks, tasks_);
    found_.resize(std::max(found_.size(), tasks_.size()));
    parallel_for(
        tasks_.size(),
        [&](std::size_t i) {
            found_[i].clear();
            BoxTree::overlaps(a, b, tasks_[i], [&](Index s, Index t) {
                const Index first = moving_[at(s)];
                const Index second = of_b[at(t)];
                found_[i].push_back(
                    {first, second, triangles_cross(tangle.surface, first, second, tangle.x)});
            });
        },
        1);
    for (std::size_t i = 0; i < tasks_.size(); ++i) {
        pairs.insert(pairs.end(), found_[i].begin(), found_[i].end());
    }
}

} // namespace weft
