#include "step/contact_forces.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

/// An edge of cloth, vertices 0 and 1, over an obstacle that moves.
Contact edge_on_obstacle() {
    return {.pair = {0, 1, 4, 5},
            .kind = PairKind::EdgeEdge,
            .vertices = {0, 1, k_no_index, k_no_index},
            .weights = {0.3, 0.7, -0.4, -0.6},
            .normal = Vec3(1.0, 2.0, 2.0) / 3.0,
            .gap = 8e-4,
            .thickness = 1e-3,
            .rest_gap = 1e-3,
            .barrier_width = 7e-4,
            .mass = 1e-4,
            .friction = 0.4,
            .static_friction = 0.4,
            .obstacle_displacement = Vec3(-2e-4, 1e-4, 3e-5)};
}

/// A vertex of cloth over a face of cloth.
Contact vertex_on_face() {
    return {.pair = {3, 0, 1, 2},
            .kind = PairKind::VertexFace,
            .vertices = {3, 0, 1, 2},
            .weights = {1.0, -0.2, -0.5, -0.3},
            .normal = Vec3(0.0, 1.0, 0.0),
            .gap = 9e-4,
            .thickness = 1e-3,
            .rest_gap = 1e-3,
            .barrier_width = 7e-4,
            .mass = 1e-4,
            .friction = 0.3,
            .static_friction = 0.5,
            .obstacle_displacement = Vec3::Zero()};
}

constexpr double k_dt = 0.01;
constexpr double k_stiffness = 500.0;

struct Two {
    std::vector<Vec3> start{Vec3(0.0, 0.0, 0.0), Vec3(0.02, 0.0, 0.01), Vec3(0.0, 0.0, 0.03),
                            Vec3(0.01, 0.0009, 0.01)};
    std::vector<Vec3> x = start;
    std::vector<Contact> contacts{edge_on_obstacle(), vertex_on_face()};
    ContactForces forces{std::vector<double>(4, k_stiffness)};

    Two() {
        x[0] += Vec3(1e-5, -2e-5, 3e-5);
        x[1] += Vec3(4e-5, -1e-5, -1e-5);
        x[3] += Vec3(3e-5, -1e-4, 0.0);
        forces.start(start, k_dt);
        forces.take(contacts);
        forces.fit_limits(x);
    }

    std::vector<Vec3> force(const std::vector<Vec3>& at) const {
        std::vector<Vec3> sum(4, Vec3::Zero());
        forces.add_forces(at, sum);
        return sum;
    }
};

} // namespace

TEST(ContactForces, BlocksAreTheDerivativesOfTheForces) {
    Two two;
    const std::vector<Index> rows{2, 0, 3, 1};
    std::vector<BlockEntry> entries;
    two.forces.list_blocks(rows, entries);
    BlockMatrix matrix = make_pattern(4, entries);
    two.forces.find_blocks(rows, std::vector<char>(4, 0), matrix);
    two.forces.add_blocks(two.x, 1.0, 0.0, matrix);

    for (std::size_t j = 0; j < 4; ++j) {
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            constexpr double step = 1e-9;
            auto low = two.x;
            auto high = two.x;
            low[j][axis] -= step;
            high[j][axis] += step;
            const auto before = two.force(low);
            const auto after = two.force(high);
            for (std::size_t i = 0; i < 4; ++i) {
                const Index place = find_block(matrix, rows[i], rows[j]);
                ASSERT_NE(place, k_no_index);
                const Vec3 expected = -matrix.blocks[static_cast<std::size_t>(place)].col(axis);
                EXPECT_LT(((after[i] - before[i]) / (2.0 * step) - expected).norm(), 1e-3);
            }
        }
    }
}

TEST(ContactForces, WorkAlongALineIsForceTimesMotion) {
    Two two;
    const std::vector<Vec3> motion{Vec3(1e-4, 0.0, 0.0), Vec3(0.0, -2e-4, 1e-5), Vec3::Zero(),
                                   Vec3(1e-5, -3e-4, 2e-4)};
    two.forces.trace(two.x, motion);

    for (const double share : {0.0, 0.3, 1.0}) {
        auto x = two.x;
        for (std::size_t i = 0; i < 4; ++i) {
            x[i] += share * motion[i];
        }
        const auto force = two.force(x);
        double work = 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
            work += force[i].dot(motion[i]);
        }
        EXPECT_NEAR(two.forces.work_along(share), work, 1e-12);
    }
}

TEST(ContactForces, BetweenClothsKeepMomentum) {
    const Two two;
    std::vector<Vec3> only_cloth(4, Vec3::Zero());
    ContactForces forces{std::vector<double>(4, k_stiffness)};
    const std::vector<Contact> contacts{vertex_on_face()};
    forces.start(two.start, k_dt);
    forces.take(contacts);
    forces.fit_limits(two.x);
    forces.add_forces(two.x, only_cloth);

    const Vec3 sum = only_cloth[0] + only_cloth[1] + only_cloth[2] + only_cloth[3];
    EXPECT_GT(only_cloth[3].y(), 0.0);
    EXPECT_LT(sum.norm(), 1e-15);
}

TEST(ContactForces, NeverPull) {
    const Two two;
    auto lifted = two.x;
    for (const std::size_t i : {0, 1}) {
        lifted[i] += 1e-2 * two.contacts[0].normal;
    }
    lifted[3] += Vec3(0.0, 2e-2, 0.0);
    ContactForces forces{std::vector<double>(4, k_stiffness)};
    forces.start(two.start, k_dt);
    forces.take(two.contacts);
    forces.fit_limits(lifted);

    std::vector<Vec3> sum(4, Vec3::Zero());
    forces.add_forces(lifted, sum);

    for (const Vec3& force : sum) {
        EXPECT_EQ(force, Vec3(Vec3::Zero()));
    }
}

TEST(ContactForces, FrictionIsStaticUntilASubstepHasSlidAndKineticAfterIt) {
    for (const double slip : {2e-5, 1e-3}) {
        for (const bool slid_before : {false, true}) {
            Two two;
            two.x = two.start;
            two.x[3] += Vec3(slip, -1e-5, 0.0);
            ContactForces forces{std::vector<double>(4, k_stiffness)};
            std::vector<Contact> contacts{vertex_on_face()};
            contacts[0].slides = slid_before;
            forces.start(two.start, k_dt);
            forces.take(contacts);
            forces.fit_limits(two.x);
            forces.report(two.x, contacts);

            const double push = contacts[0].impulse / k_dt;
            const double friction = contacts[0].friction_impulse.norm() / k_dt;
            const double limit = (slid_before ? 0.3 : 0.5) * push;
            EXPECT_GT(push, 0.0);
            EXPECT_NEAR(friction, std::min(k_stiffness * slip, limit), 1e-12);
            EXPECT_EQ(contacts[0].slides, slip - limit / k_stiffness > k_sliding_speed * k_dt);
            EXPECT_NEAR(contacts[0].slip.norm(), friction / k_stiffness, 1e-12);
        }
    }
}

} // namespace weft
