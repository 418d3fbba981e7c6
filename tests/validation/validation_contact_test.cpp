#include <gtest/gtest.h>

#include "validation/experiments.h"

namespace weft {

namespace {

void expect_all_within(const ValidationRows& rows) {
    EXPECT_FALSE(rows.empty());
    for (const ValidationRow& row : rows) {
        EXPECT_TRUE(is_within(row))
            << row.what << ": " << row.measured << " for " << row.theory << "; " << row.note;
    }
}

} // namespace

TEST(ValidationContact, SheetsStickAndSlideOnAnInclineAsCoulombSays) {
    expect_all_within(validate_incline(false));
}

TEST(ValidationContact, StripOverACylinderHoldsAsEulerSays) {
    expect_all_within(validate_capstan(false));
}

TEST(ValidationContact, FootOfABowingStripSlipsWhereTheElasticaSays) {
    expect_all_within(validate_stick_slip(false));
}

TEST(ValidationContact, TurningAndRunningBodiesCarryClothWithoutCreep) {
    expect_all_within(validate_drag(false));
}

TEST(ValidationContact, StackOfTenComesToRestAtItsThickness) {
    expect_all_within(validate_stack(false));
}

} // namespace weft
