#include "geometry/vertex_stars.h"

#include <algorithm>
#include <cassert>

namespace weft {

VertexStars::VertexStars(std::span<const Triangle> triangles, Index vertex_count)
    : first_(at(vertex_count), k_no_index), next_(3 * triangles.size(), k_no_index) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        add(static_cast<Index>(t), triangles[t]);
    }
}

void VertexStars::add(Index t, const Triangle& corners) {
    const auto vertices = at(std::max({corners[0], corners[1], corners[2]})) + 1;
    if (first_.size() < vertices) {
        first_.resize(vertices, k_no_index);
    }
    if (next_.size() < 3 * (at(t) + 1)) {
        next_.resize(3 * (at(t) + 1), k_no_index);
    }
    for (Index k = 0; k < 3; ++k) {
        Index& first = first_[at(corners[at(k)])];
        next_[at(3 * t + k)] = first;
        first = 3 * t + k;
    }
}

void VertexStars::remove(Index t, const Triangle& corners) {
    for (Index k = 0; k < 3; ++k) {
        Index* link = &first_[at(corners[at(k)])];
        while (*link != 3 * t + k) {
            assert(*link != k_no_index);
            link = &next_[at(*link)];
        }
        *link = next_[at(3 * t + k)];
    }
}

void VertexStars::triangles_of(Index v, std::vector<Index>& star) const {
    star.clear();
    for (Index corner = first_[at(v)]; corner != k_no_index; corner = next_[at(corner)]) {
        star.push_back(corner / 3);
    }
    std::sort(star.begin(), star.end());
}

bool VertexStars::is_empty(Index v) const {
    return first_[at(v)] == k_no_index;
}

} // namespace weft
