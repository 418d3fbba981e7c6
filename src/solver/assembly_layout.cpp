#include "solver/assembly_layout.h"

#include <algorithm>
#include <cassert>

namespace weft {

namespace {

/// Raises the capacity when the content outgrew it. True when it did.
bool outgrew(std::size_t count, std::size_t& capacity) {
    if (count <= capacity) {
        return false;
    }
    capacity = count + (capacity == 0 ? 0 : count / 2);
    return true;
}

} // namespace

std::vector<std::uint32_t> AssemblyLayout::Set::block_sources() const {
    const std::size_t n = nodes_per_element;
    std::vector<std::uint32_t> sources;
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t j = 0; j < n; ++j) {
            const std::size_t low = std::min(k, j);
            const std::size_t block = low * n - low * (low + 1) / 2 + std::max(k, j);
            const std::uint32_t placement = k > j ? k_transposed : k_as_is;
            sources.push_back(is_difference
                                  ? (k == j ? k_as_is : k_negative)
                                  : k_placements * static_cast<std::uint32_t>(block) + placement);
        }
    }
    return sources;
}

bool AssemblyLayout::fit(std::span<const VertexRange> objects, std::span<const ElementSet> sets) {
    bool fits = sets_.size() == sets.size() && objects_.size() == objects.size();
    assert(fits || (sets_.empty() && objects_.empty()));
    sets_.resize(sets.size());
    objects_.resize(objects.size());
    for (std::size_t s = 0; s < sets.size(); ++s) {
        Set& set = sets_[s];
        set.nodes_per_element = static_cast<std::size_t>(sets[s].nodes_per_element);
        set.reciprocal =
            ((std::uint64_t{1} << 33) + set.nodes_per_element - 1) / set.nodes_per_element;
        set.blocks_per_element = sets[s].blocks_per_element();
        set.is_constant = sets[s].is_constant;
        set.is_difference = sets[s].is_difference;
        set.count = sets[s].count();
        fits = !outgrew(set.count, set.capacity) && fits;
    }
    for (std::size_t o = 0; o < objects.size(); ++o) {
        Object& object = objects_[o];
        object.first = static_cast<std::size_t>(objects[o].first);
        object.count = static_cast<std::size_t>(objects[o].count);
        assert(o == 0 || object.first >= objects_[o - 1].first + objects_[o - 1].count);
        fits = !outgrew(object.count, object.capacity) && fits;
    }
    if (!fits) {
        lay_out();
    }
    return fits;
}

void AssemblyLayout::lay_out() {
    slot_count_ = force_count_ = block_count_ = constant_count_ = 0;
    for (Set& set : sets_) {
        std::size_t& blocks = set.is_constant ? constant_count_ : block_count_;
        set.force_begin = force_count_;
        set.block_begin = blocks;
        force_count_ += set.capacity * set.nodes_per_element;
        blocks += set.capacity * set.blocks_per_element;
    }
    assert(force_count_ < std::size_t{1} << 30);
    for (Object& object : objects_) {
        object.begin = slot_count_;
        slot_count_ += object.capacity;
    }
}

std::size_t AssemblyLayout::vertex_count() const {
    return objects_.empty() ? 0 : objects_.back().first + objects_.back().count;
}

std::size_t AssemblyLayout::object_of(Index vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    const auto after =
        std::upper_bound(objects_.begin(), objects_.end(), v,
                         [](std::size_t a, const Object& object) { return a < object.first; });
    const Object& object = *(after - 1);
    assert(v - object.first < object.count);
    return static_cast<std::size_t>(&object - objects_.data());
}

std::size_t AssemblyLayout::slot_of(Index vertex) const {
    const Object& object = objects_[object_of(vertex)];
    return object.begin + static_cast<std::size_t>(vertex) - object.first;
}

} // namespace weft
