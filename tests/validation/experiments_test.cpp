#include "validation/experiments.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

void expect_within(const ValidationRows& rows) {
    EXPECT_FALSE(rows.empty());
    for (const ValidationRow& row : rows) {
        EXPECT_TRUE(is_within(row))
            << row.what << ": " << row.measured << " for " << row.theory << "; " << row.note;
    }
}

} // namespace

TEST(Validation, PatchTest) {
    expect_within(validate_patch_test());
}

TEST(Validation, UniaxialModuli) {
    expect_within(validate_uniaxial());
}

TEST(Validation, OffAxisModuli) {
    expect_within(validate_off_axis());
}

TEST(Validation, HangingStrip) {
    expect_within(validate_hanging_strip());
}

TEST(Validation, Edges) {
    expect_within(validate_loaded_chain());
    expect_within(validate_hanging_chain());
    expect_within(validate_calibrated_edges());
}

TEST(Validation, Catenary) {
    expect_within(validate_catenary());
}

#ifndef __SANITIZE_ADDRESS__ // large direct solves: minutes there
TEST(Validation, CooksMembrane) {
    expect_within(validate_cook());
}

TEST(Validation, MeshIndependence) {
    expect_within(validate_mesh_independence());
}
#endif

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

TEST(ValidationContact, SheetsStickAndSlideOnAnInclineAsCoulombSays) {
    expect_within(validate_incline(false));
}

TEST(ValidationContact, StripOverACylinderHoldsAsEulerSays) {
    expect_within(validate_capstan(false));
}

TEST(ValidationContact, FootOfABowingStripSlipsWhereTheElasticaSays) {
    expect_within(validate_stick_slip(false));
}

TEST(ValidationContact, TurningAndRunningBodiesCarryClothWithoutCreep) {
    expect_within(validate_drag(false));
}

TEST(ValidationContact, StackOfTenComesToRestAtItsThickness) {
    expect_within(validate_stack(false));
}

} // namespace weft
