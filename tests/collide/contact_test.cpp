#include "collide/contact.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

constexpr NormalLaw k_push{.stiffness = 800.0, .barrier_width = 7e-4};

/// Before contact, light, near the end of the barrier's width, on the tangent beyond it.
constexpr std::array k_approaches{-1e-4, 1e-6, 1e-4, 5.59e-4, 5.61e-4, 2e-3};

} // namespace

TEST(NormalLaw, ForceIsTheSlopeOfItsEnergyAndTangentThatOfItsForce) {
    for (const double s : k_approaches) {
        constexpr double step = 1e-9;
        const double slope = (k_push.energy(s + step) - k_push.energy(s - step)) / (2.0 * step);
        const double tangent = (k_push.force(s + step) - k_push.force(s - step)) / (2.0 * step);

        EXPECT_NEAR(k_push.force(s), slope, 1e-6 * (1.0 + slope)) << s;
        EXPECT_NEAR(k_push.tangent(s), tangent, 1e-4 * (1.0 + tangent)) << s;
    }
}

TEST(NormalLaw, StartsAsALinearSpringAndStiffensAsItsWidthIsUsedUp) {
    EXPECT_EQ(k_push.force(0.0), 0.0);
    EXPECT_EQ(k_push.force(-1e-3), 0.0);
    EXPECT_NEAR(k_push.tangent(1e-12), 800.0, 1e-4);
    EXPECT_NEAR(k_push.tangent(7e-4), 25.0 * 800.0, 1e-6);
}

} // namespace weft
