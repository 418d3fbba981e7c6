#include "state/body.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(Body, CarriesItsSurfaceWithEachAffineMotionOfItsParticles) {
    Body body;
    body.first_vertex = 1;
    body.vertex_count = 2;
    body.first_particle = 3;
    body.particle_count = 4;
    body.embeddings.resize(2);
    body.embeddings[0] = {{0, 1, 2, 3}, {0.1, 0.2, 0.3, 0.4}};
    body.embeddings[1].particles[0] = 2;
    body.embeddings[1].weights[0] = 1.0;
    std::vector<Vec3> x(7, Vec3(9.0, 9.0, 9.0));
    x[3] = Vec3(0.0, 0.0, 0.0);
    x[4] = Vec3(1.0, 0.0, 0.0);
    x[5] = Vec3(0.0, 1.0, 0.0);
    x[6] = Vec3(0.0, 0.0, 1.0);
    Mat3 affine;
    affine << 1.0, 2.0, 0.5, -0.3, 0.8, 0.0, 0.0, 0.1, -2.0;
    const Vec3 shift(0.4, -0.2, 7.0);
    for (std::size_t i = 3; i < 7; ++i) {
        x[i] = affine * x[i] + shift;
    }
    interpolate_embedded(body, x);
    EXPECT_EQ(x[0], Vec3(9.0, 9.0, 9.0)) << "not the body's";
    EXPECT_LT((x[1] - (affine * Vec3(0.2, 0.3, 0.4) + shift)).norm(), 1e-14);
    EXPECT_LT((x[2] - (affine * Vec3(0.0, 1.0, 0.0) + shift)).norm(), 1e-14);
}

} // namespace
} // namespace weft
