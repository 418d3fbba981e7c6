#include "solver/element_rooms.h"

#include <algorithm>
#include <cassert>

namespace weft {

namespace {

/// Makes room when the content outgrew it. True when it did.
bool outgrew(std::size_t count, std::size_t& capacity) {
    if (count <= capacity) {
        return false;
    }
    capacity = count + (capacity == 0 ? 0 : count / 2);
    return true;
}

} // namespace

bool ElementRooms::fit(std::span<const VertexRange> objects, std::span<const ElementSet> sets) {
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

void ElementRooms::lay_out() {
    site_count_ = force_count_ = block_count_ = constant_count_ = 0;
    for (Set& set : sets_) {
        std::size_t& blocks = set.is_constant ? constant_count_ : block_count_;
        set.force_begin = force_count_;
        set.block_begin = blocks;
        force_count_ += set.capacity * set.nodes_per_element;
        blocks += set.capacity * set.blocks_per_element;
    }
    assert(force_count_ < std::size_t{1} << 30);
    for (Object& object : objects_) {
        object.begin = site_count_;
        site_count_ += object.capacity;
    }
}

std::size_t ElementRooms::vertex_count() const {
    return objects_.empty() ? 0 : objects_.back().first + objects_.back().count;
}

std::size_t ElementRooms::object_of(Index vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    const auto after =
        std::upper_bound(objects_.begin(), objects_.end(), v,
                         [](std::size_t a, const Object& object) { return a < object.first; });
    const Object& object = *(after - 1);
    assert(v - object.first < object.count);
    return static_cast<std::size_t>(&object - objects_.data());
}

std::size_t ElementRooms::site_of(Index vertex) const {
    const Object& object = objects_[object_of(vertex)];
    return object.begin + static_cast<std::size_t>(vertex) - object.first;
}

} // namespace weft
