#include "geometry/inset.h"
#include "geometry/shapes.h"

#include <gtest/gtest.h>

namespace weft {

TEST(Inset, OfABallIsItsRadiusAndPointsToItsCentre) {
    const TriangleMesh ball = sphere_mesh(0.1);

    const Inset inset = find_inset(ball.positions, ball.triangles, 0.03);

    for (std::size_t v = 0; v < ball.positions.size(); ++v) {
        EXPECT_NEAR(inset.limit[v], 0.03, 1e-12); // 0.45 of 0.2 m is more than was asked for
        EXPECT_LT((inset.inward[v] + ball.positions[v].normalized()).norm(), 0.03);
        EXPECT_LT((ball.positions[v] + inset.displacement(v, 0.02)).norm(), 0.081);
    }
}

TEST(Inset, StaysBelowHalfOfAThinPlate) {
    const TriangleMesh plate = box_mesh({1.0, 0.01, 1.0});

    const Inset inset = find_inset(plate.positions, plate.triangles, 0.1);

    for (std::size_t v = 0; v < plate.positions.size(); ++v) {
        const Vec3 x = plate.positions[v] + inset.displacement(v, 0.1);
        EXPECT_GT(x.y() * plate.positions[v].y(), 0.0) << v;
        // at corners the way through is slanted: sqrt(3) of the thickness, of which 45 %
        EXPECT_LE(inset.limit[v], 0.45 * std::sqrt(3.0) * 0.01 + 1e-9);
        EXPECT_GT(inset.limit[v], 0.0);
    }
}

TEST(Inset, ChangesAlongTheSurfaceByHalfTheWayAtMost) {
    TriangleMesh ball = sphere_mesh(0.1);
    for (Vec3& x : ball.positions) {
        x.y() *= x.x() > 0.0 ? 0.1 : 1.0; // one half is pressed flat
    }

    const Inset inset = find_inset(ball.positions, ball.triangles, 0.05);

    for (const Triangle& t : ball.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = at(t[k]);
            const auto b = at(t[(k + 1) % 3]);
            const double length = (ball.positions[a] - ball.positions[b]).norm();
            EXPECT_LE(std::abs(inset.limit[a] - inset.limit[b]), 0.5 * length + 1e-12);
        }
    }
}

TEST(Inset, TurnsNoTriangleOver) {
    const TriangleMesh box = box_mesh({0.3, 0.2, 0.1});

    const Inset inset = find_inset(box.positions, box.triangles, 0.04);

    for (const Triangle& t : box.triangles) {
        std::array<Vec3, 3> before, after;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto v = at(t[k]);
            before[k] = box.positions[v];
            after[k] = before[k] + inset.displacement(v, 0.04);
        }
        EXPECT_GT(triangle_normal(before[0], before[1], before[2])
                      .dot(triangle_normal(after[0], after[1], after[2])),
                  0.3);
    }
}

} // namespace weft
