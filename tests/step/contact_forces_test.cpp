#include "step/contact_forces.h"

#include <gtest/gtest.h>

#include <numbers>

namespace weft {

namespace {

/// An edge of cloth, vertices 0 and 1, above an obstacle that moves.
RestingContact edge_contact() {
    return {.pair = {0, 1, 2, 3},
            .vertices = {0, 1, k_no_index, k_no_index},
            .weights = {0.3, 0.7, 0.0, 0.0},
            .obstacle_velocity = Vec3(-0.02, 0.01, 0.03),
            .normal = Vec3(1.0, 2.0, 2.0) / 3.0,
            .depth = 2e-4,
            .mass = 1e-4,
            .friction = 0.4};
}

constexpr double k_dt = 0.01;
constexpr double k_stiffness = 500.0;

struct Edge {
    std::vector<Vec3> x{Vec3(0.0, 0.0, 0.0), Vec3(0.02, 0.0, 0.01)};
    std::vector<Vec3> v{Vec3(0.001, 0.0, 0.002), Vec3(0.0, -0.001, 0.0)};
    std::vector<RestingContact> contacts{edge_contact()};
    ContactForces forces{{k_stiffness, k_stiffness}};

    Edge() { forces.start(contacts, x, v, v, k_dt); }

    std::array<Vec3, 2> force(const std::vector<Vec3>& at, const std::vector<Vec3>& speed) const {
        std::vector<Vec3> sum(2, Vec3::Zero());
        forces.add_forces(at, speed, sum);
        return {sum[0], sum[1]};
    }
};

} // namespace

TEST(ContactForces, BlocksAreTheDerivativesOfTheForces) {
    const Edge edge;
    const std::vector<BlockEntry> entries{{0, 1}};
    const std::vector<Index> rows{0, 1};
    BlockMatrix matrix = make_pattern(2, entries);
    constexpr double beta = 0.007;
    edge.forces.add_blocks(beta, rows, matrix);

    for (std::size_t j = 0; j < 2; ++j) {
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            constexpr double step = 1e-6; // forces are linear: the difference has no other error
            auto x = edge.x;
            auto v = edge.v;
            x[j][axis] += beta * beta * step;
            v[j][axis] += beta * step;
            const auto before = edge.force(edge.x, edge.v);
            const auto after = edge.force(x, v);
            for (std::size_t i = 0; i < 2; ++i) {
                const Index place =
                    find_block(matrix, static_cast<Index>(i), static_cast<Index>(j));
                const Vec3 expected = -matrix.blocks[static_cast<std::size_t>(place)].col(axis);
                EXPECT_LT(((after[i] - before[i]) / step - expected).norm(), 1e-6);
            }
        }
    }
}

TEST(ContactForces, PushesOutOfTheObstacleInProportionToTheDepth) {
    const Edge edge;
    std::vector<Vec3> carried_along = edge.x; // moved as the obstacle's share says: the same depth
    for (Vec3& x : carried_along) {
        x -= k_dt * edge.contacts[0].obstacle_velocity;
    }
    const std::vector<Vec3> still(2, Vec3(-edge.contacts[0].obstacle_velocity));

    const auto force = edge.force(carried_along, still);

    const Vec3 expected = k_stiffness * 2e-4 * edge.contacts[0].normal;
    EXPECT_LT((force[0] - 0.3 * expected).norm(), 1e-12);
    EXPECT_LT((force[1] - 0.7 * expected).norm(), 1e-12);
}

TEST(ContactForces, NeverPullsOnceRevised) {
    Edge edge;
    std::vector<Vec3> lifted = edge.x;
    for (Vec3& x : lifted) {
        x += 1e-3 * edge.contacts[0].normal;
    }

    EXPECT_TRUE(edge.forces.revise(lifted, edge.v));

    const auto force = edge.force(lifted, edge.v);
    EXPECT_EQ(force[0], Vec3(Vec3::Zero()));
    EXPECT_EQ(force[1], Vec3(Vec3::Zero()));
}

TEST(ContactForces, FrictionDoesNotExceedCoulombsConeOnceRevised) {
    Edge edge;
    const std::vector<Vec3> fast(2, Vec3(2.0, -1.0, 0.0)); // across the normal

    EXPECT_TRUE(edge.forces.revise(edge.x, fast));

    const auto force = edge.force(edge.x, fast);
    const Vec3 total = force[0] + force[1];
    const double along = total.dot(edge.contacts[0].normal);
    EXPECT_GT(along, 0.0);
    EXPECT_LE((total - along * edge.contacts[0].normal).norm(), 0.4 * along);
}

} // namespace weft
