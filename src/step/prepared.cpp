#include "step/prepared.h"

#include "remesh/adapt_world.h"

#include <cassert>

namespace weft {

Prepared::Prepared(World world, const SceneParams& scene, const ContactParams& contact)
    : world_(std::move(world)), scene_(scene), contact_(contact) {
    make_adaptive(world_);
}

StartPositions::StartPositions(const World& start) {
    auto next = start.positions.begin();
    for (const Cloth& cloth : start.cloths) {
        const auto end = next + cloth.vertex_count;
        cloths_.emplace_back(next, cloth.refinement.empty() ? end : next);
        next = end;
    }
    bodies_.assign(next, start.positions.end());
}

std::vector<Vec3> StartPositions::of(const World& world) const {
    std::vector<Vec3> start;
    start.reserve(world.vertex_count());
    for (std::size_t c = 0; c < cloths_.size(); ++c) {
        const Refinement& refinement = world.cloths[c].refinement;
        const std::vector<Vec3>& own = refinement.empty() ? cloths_[c] : refinement.start;
        start.insert(start.end(), own.begin(), own.end());
    }
    start.insert(start.end(), bodies_.begin(), bodies_.end());
    assert(start.size() == world.vertex_count());
    return start;
}

} // namespace weft
