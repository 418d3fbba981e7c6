#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "validation/experiments.h"
#include "validation/motion.h"

namespace weft {

namespace {

void expect_within(const ValidationRows& rows) {
    EXPECT_FALSE(rows.empty());
    for (const ValidationRow& row : rows) {
        EXPECT_TRUE(is_within(row)) << row.what << ": " << row.measured << " for " << row.theory;
    }
}

} // namespace

TEST(MeanPeriod, OfASampledSineIsItsOwn) {
    std::vector<double> sine;
    for (int n = 1; n <= 500; ++n) {
        sine.push_back(std::sin(2.0 * std::numbers::pi * (0.01 * n / 0.73 - 0.3)));
    }

    EXPECT_NEAR(mean_period(sine, 0.01), 0.73, 1e-5);
}

TEST(MeanPeriod, NeedsTwoRises) {
    const std::vector<double> one_rise{-1.0, 1.0, 2.0, -1.0};

    EXPECT_TRUE(std::isnan(mean_period(one_rise, 0.1)));
}

TEST(ValidationDynamics, BothIntegratorsFallAsTheirSumsSay) {
    expect_within(validate_free_fall());
}

TEST(ValidationDynamics, VibrationsDecayAsTheIntegratorsDo) {
    expect_within(validate_energy_decay());
}

TEST(ValidationDynamics, MomentumIsKept) {
    expect_within(validate_momentum());
}

TEST(ValidationDynamics, SheetsThatCollideKeepTheirMomentum) {
    expect_within(validate_contact_momentum(false));
}

TEST(ValidationDynamics, StretchedMembraneSoundsAtItsFrequency) {
    expect_within(validate_membrane_frequency());
}

TEST(ValidationDynamics, PeriodsAreTheSameOnMeshesRefinedAndCoarsenedAsTheyBend) {
    expect_within(validate_adaptive_periods());
}

TEST(ValidationDynamics, IntegratorsHaveTheirOrder) {
    expect_within(validate_order_in_time());
}

TEST(ValidationDynamics, MembraneIsOfSecondOrderInSpace) {
    expect_within(validate_order_in_space());
}

} // namespace weft
