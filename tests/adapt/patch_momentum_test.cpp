#include "adapt/state_transfer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace weft {
namespace {

/// Point masses that move.
struct Patch {
    std::vector<double> m;
    std::vector<Vec3> x, v;

    PatchMomentum momentum() const {
        PatchMomentum sum;
        for (std::size_t i = 0; i < m.size(); ++i) {
            sum.add(m[i], x[i], v[i]);
        }
        return sum;
    }
    void restore(const PatchMomentum& before) { restore_momentum(before, m, x, v); }
};

class RandomNumbers {
public:
    explicit RandomNumbers(unsigned seed) : random_(seed) {}
    double number() { return uniform_(random_); }
    Vec3 vector() { return {number(), number(), number()}; }

private:
    std::mt19937 random_;
    std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

/// 6 to 20 vertices within 3 cm of a place up to a metre from the origin, a gram or so each.
Patch random_patch(RandomNumbers& random) {
    Patch patch;
    const Vec3 place = random.vector();
    const auto count = static_cast<std::size_t>(6.0 + 7.0 * (1.0 + random.number()));
    for (std::size_t i = 0; i < count; ++i) {
        patch.m.push_back(1e-3 * (1.1 + random.number()));
        patch.x.push_back(place + 0.03 * random.vector());
        patch.v.push_back(random.vector());
    }
    return patch;
}

/// The same mass on the vertices in other parts: the fraction k of it goes from one to another.
void shift_masses(Patch& patch, RandomNumbers& random, double k = 0.3) {
    for (std::size_t i = 1; i < patch.m.size(); ++i) {
        const double shifted = k * random.number() * std::min(patch.m[i], patch.m[i - 1]);
        patch.m[i] += shifted;
        patch.m[i - 1] -= shifted;
    }
}

double scale_of(const PatchMomentum& p) {
    return std::sqrt(2.0 * p.mass * p.kinetic); // >= |linear|
}

TEST(PatchMomentum, SumsMassTimesVelocityAndItsMoment) {
    PatchMomentum sum;
    sum.add(2.0, {1.0, 0.0, 0.0}, {0.0, 3.0, 0.0});
    PatchMomentum other;
    other.add(1.0, {0.0, 1.0, 0.0}, {2.0, 0.0, 0.0});

    sum += other;

    EXPECT_EQ(sum.mass, 3.0);
    EXPECT_EQ(sum.linear, Vec3(2.0, 6.0, 0.0));
    EXPECT_EQ(sum.angular, Vec3(0.0, 0.0, 6.0 - 2.0));
    EXPECT_EQ(sum.kinetic, 9.0 + 2.0);
}

TEST(PatchMomentum, GetsBackBothMomenta) {
    RandomNumbers random(1);
    for (int i = 0; i < 1000; ++i) {
        Patch patch = random_patch(random);
        const PatchMomentum before = patch.momentum();
        shift_masses(patch, random);

        patch.restore(before);

        const PatchMomentum now = patch.momentum();
        EXPECT_LT((now.linear - before.linear).norm(), 1e-12 * scale_of(before));
        EXPECT_LT((now.angular - before.angular).norm(), 1e-12 * scale_of(before));
    }
}

TEST(PatchMomentum, GainsNoEnergyWhereMassesChangeALittle) {
    RandomNumbers random(1);
    for (int i = 0; i < 1000; ++i) {
        Patch patch = random_patch(random);
        const PatchMomentum before = patch.momentum();
        shift_masses(patch, random, 0.005);

        patch.restore(before);

        EXPECT_LE(patch.momentum().kinetic, before.kinetic * (1.0 + 1e-13));
    }
}

TEST(PatchMomentum, LeavesVelocitiesAsTheyAreWhereNothingIsMissing) {
    RandomNumbers random(2);
    for (int i = 0; i < 100; ++i) {
        const Patch before = random_patch(random);
        Patch patch = before;

        patch.restore(before.momentum());

        for (std::size_t k = 0; k < patch.v.size(); ++k) {
            EXPECT_LT((patch.v[k] - before.v[k]).norm(), 1e-12);
        }
    }
}

TEST(PatchMomentum, LeavesWhatRestsAtRest) {
    RandomNumbers random(3);
    Patch patch = random_patch(random);
    std::fill(patch.v.begin(), patch.v.end(), Vec3(Vec3::Zero()));
    const PatchMomentum before = patch.momentum();
    shift_masses(patch, random);

    patch.restore(before);

    for (const Vec3& v : patch.v) {
        EXPECT_EQ(v, Vec3(Vec3::Zero()));
    }
}

TEST(PatchMomentum, OfVerticesInALineIsRestoredButForTheSpinAboutIt) {
    RandomNumbers random(4);
    for (int i = 0; i < 100; ++i) {
        Patch patch = random_patch(random);
        const Vec3 direction = random.vector().normalized();
        for (Vec3& x : patch.x) {
            x = 0.03 * random.number() * direction;
        }
        const PatchMomentum before = patch.momentum();
        shift_masses(patch, random);

        patch.restore(before);

        const PatchMomentum now = patch.momentum();
        EXPECT_LT((now.linear - before.linear).norm(), 1e-12 * scale_of(before));
        EXPECT_LT((now.angular - before.angular).norm(), 1e-12 * scale_of(before));
    }
}

TEST(PatchMomentum, OfVerticesInOnePointIsRestoredAsFarAsItMoves) {
    RandomNumbers random(5);
    Patch patch = random_patch(random);
    std::fill(patch.x.begin(), patch.x.end(), patch.x[0]);
    const PatchMomentum before = patch.momentum();
    shift_masses(patch, random);

    patch.restore(before);

    const PatchMomentum now = patch.momentum();
    EXPECT_LT((now.linear - before.linear).norm(), 1e-12 * scale_of(before));
    EXPECT_LT((now.angular - before.angular).norm(), 1e-12 * scale_of(before));
}

/// Then momentum and energy cannot both stay: L^2 / 2I is the least energy of a spin L.
TEST(PatchMomentum, OfARigidSpinIsKeptAtTheLeastEnergyThatItCanHave) {
    Patch patch{{1.0, 1.0, 1.0, 1.0},
                {{1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, {0.0, -2.0, 0.0}},
                {{0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}, {-2.0, 0.0, 0.0}, {2.0, 0.0, 0.0}}};
    const PatchMomentum before = patch.momentum(); // about z: inertia 10, spin 1
    patch.m = {1.5, 1.5, 0.5, 0.5};                // inertia 7

    patch.restore(before);

    const PatchMomentum now = patch.momentum();
    EXPECT_NEAR((now.angular - before.angular).norm(), 0.0, 1e-14);
    EXPECT_NEAR(now.kinetic, 0.5 * 10.0 * 10.0 / 7.0, 1e-13);
}

TEST(PatchMomentum, OfARigidSpinDoesNotDampWhatElseMoves) {
    Patch patch{{1.0, 1.0, 1.0, 1.0},
                {{1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, {0.0, -2.0, 0.0}},
                {{0.0, 1.0, 0.1}, {0.0, -1.0, 0.1}, {-2.0, 0.0, -0.1}, {2.0, 0.0, -0.1}}};
    const PatchMomentum before = patch.momentum(); // as above, and bends
    patch.m = {1.5, 1.5, 0.5, 0.5};

    patch.restore(before);

    const double bending = patch.v[0].z() + patch.v[1].z() - patch.v[2].z() - patch.v[3].z();
    EXPECT_NEAR(bending, 0.4, 0.02 * 0.4 + 1e-12);
}

} // namespace
} // namespace weft
