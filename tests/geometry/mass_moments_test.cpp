#include "geometry/mass_moments.h"
#include "support/random_rotation.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

/// Box of edge lengths 2, 4, 6 with one corner in the origin, turned and moved.
TriangleMesh turned_box(const Mat3& R, const Vec3& centre) {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) {
        const Vec3 corner((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 2.0 : -2.0,
                          (i & 4) != 0 ? 3.0 : -3.0);
        mesh.positions.push_back(R * corner + centre);
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

} // namespace

TEST(MassMoments, OfABoxAreThoseOfTheFormula) {
    std::mt19937 random(1);
    const Mat3 R = test::random_rotation(random);
    const Vec3 centre(5.0, -7.0, 11.0);

    const MassMoments moments = mass_moments(turned_box(R, centre));

    // mean of x^2 over an edge of length a: a^2 / 12
    const Mat3 second = R * Vec3(4.0 / 12.0, 16.0 / 12.0, 36.0 / 12.0).asDiagonal() * R.transpose();
    EXPECT_NEAR(moments.volume, 48.0, 1e-11);
    EXPECT_LT((moments.centre - centre).norm(), 1e-12);
    EXPECT_LT((moments.second - second).norm(), 1e-12);
}

TEST(MassMoments, AreTheSameInsideOutButForTheVolume) {
    TriangleMesh mesh = turned_box(Mat3::Identity(), Vec3(1.0, 2.0, 3.0));
    const MassMoments moments = mass_moments(mesh);
    for (Triangle& t : mesh.triangles) {
        std::swap(t[1], t[2]);
    }

    const MassMoments turned = mass_moments(mesh);

    EXPECT_NEAR(turned.volume, -moments.volume, 1e-12);
    EXPECT_LT((turned.centre - moments.centre).norm(), 1e-13);
    EXPECT_LT((turned.second - moments.second).norm(), 1e-13);
}

} // namespace weft
