#include "remesh/relax_after_remesh.h"
#include "support/adapting_world.h"
#include "support/surface_energy.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

using test::AdaptingWorld;
using test::SheetMotion;

const Vec3 k_gravity(0.0, -9.81, 0.0); // m/s^2

/// What relax_after_remesh() made of one adaptation of a sheet in waves.
struct Relaxation {
    double gain = 0.0, left = 0.0; ///< of all patches that gained, J
    double fall = 0.0;             ///< of the whole cloth's energy, J
    double energy = 0.0;           ///< of the whole cloth, J
    double farthest = 0.0;         ///< any vertex went, m
    bool moved_a_held_one = false, named_all = true;
};

Relaxation relax(AdaptingWorld& sheets, double fraction, double farthest, bool holds_odd_ones) {
    const World before = sheets.world;
    const ClothChanges changes = sheets.adapt(0, 15, fraction);
    const Cloth& cloth = sheets.world.cloths[0];
    const auto places = sheets.world.positions_of(cloth);
    const std::vector<Vec3> start(places.begin(), places.end());
    std::vector<Vec3> x = start;
    std::vector<char> may_move(x.size(), 1);
    for (std::size_t v = 1; v < x.size() && holds_odd_ones; v += 2) {
        may_move[v] = 0;
    }
    const VertexStars stars(cloth.triangles, cloth.vertex_count);
    BendElements bends(cloth);
    std::vector<Index> shifted;
    Relaxation result;
    for (const ChangedPatch& patch :
         find_changed_patches({before.cloths[0], before.positions_of(before.cloths[0])},
                              {cloth, start}, changes, k_gravity)) {
        if (patch.gain > 0.0) {
            result.gain += patch.gain;
            result.left += relax_after_remesh(
                {cloth, stars, bends, k_gravity, may_move, farthest, x}, patch, shifted);
        }
    }
    result.energy = test::surface_energy(cloth, start, k_gravity);
    result.fall = result.energy - test::surface_energy(cloth, x, k_gravity);
    for (std::size_t v = 0; v < x.size(); ++v) {
        const bool moved = x[v] != start[v];
        result.farthest = std::max(result.farthest, (x[v] - start[v]).norm());
        result.moved_a_held_one = result.moved_a_held_one || (moved && may_move[v] == 0);
        const auto named = std::count(shifted.begin(), shifted.end(), static_cast<Index>(v));
        result.named_all = result.named_all && named == (moved ? 1 : 0);
    }
    return result;
}

} // namespace

TEST(RelaxAfterRemesh, TakesMostOfWhatFlipsAcrossFoldsGave) {
    AdaptingWorld waves(SheetMotion::Wave, 2);
    double gain = 0.0, left = 0.0;
    for (int adaptation = 0; adaptation < 12; ++adaptation) {
        const Relaxation done = relax(waves, 0.8, 0.02, false);
        gain += done.gain;
        left += std::max(0.0, done.left);
    }
    EXPECT_GT(gain, 0.0);
    EXPECT_LT(left, 0.3 * gain);
}

TEST(RelaxAfterRemesh, SaysHowMuchTheClothGaveWay) {
    for (const SheetMotion motion : {SheetMotion::Wave, SheetMotion::Crumple}) {
        AdaptingWorld sheets(motion, 4);
        for (int adaptation = 0; adaptation < 12; ++adaptation) {
            const Relaxation done = relax(sheets, 0.6, 0.01, false);
            EXPECT_NEAR(done.gain - done.left, done.fall, 1e-9 * (1.0 + std::abs(done.energy)));
            EXPECT_TRUE(done.named_all);
        }
    }
}

TEST(RelaxAfterRemesh, MovesNoVertexTooFarAndNoneThatIsHeld) {
    constexpr double k_farthest = 1e-3; // m
    AdaptingWorld sheets(SheetMotion::Crumple, 6);
    double farthest = 0.0;
    for (int adaptation = 0; adaptation < 12; ++adaptation) {
        const Relaxation done = relax(sheets, 0.6, k_farthest, true);
        EXPECT_LE(done.farthest, k_farthest * (1.0 + 1e-12));
        EXPECT_FALSE(done.moved_a_held_one);
        farthest = std::max(farthest, done.farthest);
    }
    EXPECT_GT(farthest, 0.5 * k_farthest);
}

} // namespace weft
