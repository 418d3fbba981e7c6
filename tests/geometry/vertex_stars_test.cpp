#include "geometry/vertex_stars.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace weft {

TEST(VertexStars, AreThoseOfTheTrianglesEnteredAndNotTakenOut) {
    std::mt19937 random(4);
    constexpr Index k_vertices = 12;
    std::vector<Triangle> triangles;
    for (int t = 0; t < 60; ++t) {
        const auto a = static_cast<Index>(random() % k_vertices);
        triangles.push_back({a, (a + 1 + static_cast<Index>(random() % 5)) % k_vertices,
                             (a + 6 + static_cast<Index>(random() % 6)) % k_vertices});
    }
    VertexStars stars({triangles.data(), 30}, k_vertices);
    for (Index t = 30; t < 60; ++t) {
        stars.add(t, triangles[static_cast<std::size_t>(t)]);
    }
    std::vector<char> is_in(60, 1);
    for (Index t = 0; t < 60; t += 1 + static_cast<Index>(random() % 3)) {
        stars.remove(t, triangles[static_cast<std::size_t>(t)]);
        is_in[static_cast<std::size_t>(t)] = 0;
    }

    for (Index v = 0; v < k_vertices; ++v) {
        std::vector<Index> expected, star;
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            if (is_in[t] && std::count(triangles[t].begin(), triangles[t].end(), v) > 0) {
                expected.push_back(static_cast<Index>(t));
            }
        }
        stars.triangles_of(v, star);
        EXPECT_EQ(star, expected) << "vertex " << v;
        EXPECT_EQ(stars.is_empty(v), expected.empty());
    }
}

} // namespace weft
