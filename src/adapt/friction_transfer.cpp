#include "adapt/friction_transfer.h"

#include <algorithm>
#include <cassert>

namespace weft {

namespace {

bool comes_before(const FrictionHistory& a, const FrictionHistory& b) {
    return a.pair < b.pair;
}

/// First vertices of all objects that touch, ascending.
std::vector<Index> first_vertices_of_objects(const World& world) {
    std::vector<Index> first;
    for (const Cloth& cloth : world.cloths) {
        first.push_back(cloth.first_vertex);
    }
    for_each_body(world, [&](const Body& body) { first.push_back(body.first_vertex); });
    auto next = static_cast<Index>(world.vertex_count());
    for (const Obstacle& obstacle : world.obstacles) {
        first.push_back(next);
        next += static_cast<Index>(obstacle.mesh.positions.size());
    }
    return first;
}

} // namespace

FrictionTransfer::FrictionTransfer(World& world, Index first, std::span<const char> is_changed)
    : first_(first), old_count_(static_cast<Index>(is_changed.size())),
      objects_(first_vertices_of_objects(world)) {
    assert(std::is_sorted(objects_.begin(), objects_.end()));
    const auto is_own = [&](Index v) { return v >= first_ && v < first_ + old_count_; };
    const auto changes = [&](Index v) { return is_own(v) && is_changed[at(v - first_)] != 0; };
    std::erase_if(world.friction_history, [&](const FrictionHistory& memory) {
        if (is_transfer(memory) &&
            is_own(memory.pair[0])) { // the adaptation just before this one left it
            add(world, memory.pair[0], memory.pair[3], memory, 1.0);
            return true;
        }
        if (is_transfer(memory) || std::none_of(memory.pair.begin(), memory.pair.end(), changes)) {
            return false;
        }
        take(world, memory);
        return true;
    });
    std::stable_sort(transfers_.begin(), transfers_.end(), comes_before);
    join_equal();
}

/// A side lies in one object. Of a pair within the cloth only the first vertex and the last are
/// known to lie on different sides; each of them has half of it.
void FrictionTransfer::take(const World& world, const FrictionHistory& pair) {
    const auto is_own = [&](Index v) { return v >= first_ && v < first_ + old_count_; };
    const Index front = pair.pair.front();
    const Index back = pair.pair.back();
    if (is_own(front) && is_own(back)) {
        add(world, front, first_, pair, 0.5);
        add(world, back, first_, pair, -0.5);
        return;
    }
    const Index partner = is_own(front) ? back : front;
    const auto count = std::count_if(pair.pair.begin(), pair.pair.end(), is_own);
    const double weight = (is_own(front) ? 1.0 : -1.0) / static_cast<double>(count);
    for (const Index v : pair.pair) {
        if (is_own(v)) {
            add(world, v, partner, pair, weight);
        }
    }
}

void FrictionTransfer::add(
    const World& world, Index vertex, Index partner, const FrictionHistory& pair, double weight) {
    const Index object = *(std::upper_bound(objects_.begin(), objects_.end(), partner) - 1);
    transfers_.push_back({transfer_key(vertex - first_, object), pair.rest_gap,
                          weight / world.masses[at(vertex)] * pair.slip, pair.slides});
}

/// Sums those of one vertex and object.
void FrictionTransfer::join_equal() {
    std::size_t count = 0;
    for (const FrictionHistory& one : transfers_) {
        if (count == 0 || transfers_[count - 1].pair != one.pair) {
            transfers_[count++] = one;
            continue;
        }
        FrictionHistory& sum = transfers_[count - 1];
        sum.slip += one.slip;
        sum.rest_gap = std::max(sum.rest_gap, one.rest_gap);
        sum.slides |= one.slides;
    }
    transfers_.resize(count);
}

std::span<const FrictionHistory> FrictionTransfer::of(Index vertex) const {
    const auto begin =
        std::partition_point(transfers_.begin(), transfers_.end(),
                             [&](const FrictionHistory& one) { return one.pair[0] < vertex; });
    const auto end = std::partition_point(
        begin, transfers_.end(), [&](const FrictionHistory& one) { return one.pair[0] == vertex; });
    return {begin, end};
}

void FrictionTransfer::inherit(const VertexParents& place) {
    assert(transfers_.empty() || transfers_.back().pair[0] < place.vertex);
    std::vector<FrictionHistory> own; // one an object: few
    std::vector<double> weights;      // the parents' that touch it
    for (std::size_t k = 0; k < 3 && place.parents[k] != k_no_index; ++k) {
        for (const FrictionHistory& one : of(place.parents[k])) {
            const auto pair = transfer_key(place.vertex, one.pair[3]);
            const auto known =
                std::find_if(own.begin(), own.end(), [&](const auto& o) { return o.pair == pair; });
            const auto i = static_cast<std::size_t>(known - own.begin());
            if (known == own.end()) {
                own.push_back({pair, 0.0, Vec3::Zero(), 0});
                weights.push_back(0.0);
            }
            own[i].slip += place.weights[k] * one.slip;
            own[i].rest_gap += place.weights[k] * one.rest_gap;
            own[i].slides |= one.slides;
            weights[i] += place.weights[k];
        }
    }
    for (std::size_t i = 0; i < own.size(); ++i) {
        own[i].rest_gap /= weights[i];
    }
    std::sort(own.begin(), own.end(), comes_before);
    transfers_.insert(transfers_.end(), own.begin(), own.end());
}

void FrictionTransfer::leave(World& world,
                             std::span<const Index> former,
                             std::span<const double> masses) const {
    const auto count = static_cast<Index>(former.size());
    for (Index v = 0; v < count; ++v) {
        for (FrictionHistory one : of(former[at(v)])) {
            const Index object = one.pair[3]; // the first vertex of a cloth stays
            one.pair =
                transfer_key(first_ + v, object > first_ ? object + count - old_count_ : object);
            one.slip *= masses[at(v)];
            world.friction_history.push_back(one);
        }
    }
    std::sort(world.friction_history.begin(), world.friction_history.end(), comes_before);
}

} // namespace weft
