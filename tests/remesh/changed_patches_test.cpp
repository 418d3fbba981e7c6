#include "forces/membrane.h"
#include "remesh/relax_after_remesh.h"
#include "support/adapting_world.h"
#include "support/surface_energy.h"

#include <gtest/gtest.h>

#include <map>

namespace weft {

namespace {

using test::AdaptingWorld;
using test::SheetMotion;

const Vec3 k_gravity(0.5, -9.81, 1.0); // m/s^2

template <typename Elements>
void add_forces(const Elements& elements,
                const std::vector<Vec3>& element_forces,
                std::vector<Vec3>& forces) {
    for (std::size_t i = 0; i < element_forces.size(); ++i) {
        if (elements.nodes()[i] != k_no_index) {
            forces[static_cast<std::size_t>(elements.nodes()[i])] += element_forces[i];
        }
    }
}

std::vector<Vec3> elastic_forces(const Cloth& cloth, std::span<const Vec3> x) {
    std::vector<Vec3> forces(x.size(), Vec3::Zero());
    const std::vector<Vec3> still(x.size(), Vec3::Zero());
    const MembraneElements membrane(cloth);
    std::vector<Vec3> of_elements(membrane.nodes().size());
    membrane.forces(x, still, of_elements);
    add_forces(membrane, of_elements, forces);
    const ConstantBending bending(cloth);
    of_elements.resize(bending.nodes().size());
    bending.forces(x, of_elements);
    add_forces(bending, of_elements, forces);
    return forces;
}

/// Elastic forces by the names of the first cloth's vertices.
std::map<int, Vec3> named_forces(const AdaptingWorld& sheets) {
    const Cloth& cloth = sheets.world.cloths[0];
    const std::vector<Vec3> forces = elastic_forces(cloth, sheets.world.positions_of(cloth));
    const std::vector<int> names = sheets.names();
    std::map<int, Vec3> named;
    for (std::size_t v = 0; v < forces.size(); ++v) {
        named[names[v]] = forces[v];
    }
    return named;
}

class ChangedPatches : public testing::TestWithParam<BendModel> {
protected:
    AdaptingWorld sheets(SheetMotion motion) const {
        AdaptingWorld sheets(motion, 11);
        sheets.world.cloths[0].params.bend_model = GetParam();
        sheets.world.cloths[0].params.fabric.bend_stiffness = 1e-3;
        return sheets;
    }
};

} // namespace

TEST_P(ChangedPatches, AddUpToWhatTheWholeClothGains) {
    AdaptingWorld crumpled = sheets(SheetMotion::Crumple);
    for (int adaptation = 0; adaptation < 30; ++adaptation) {
        const World before = crumpled.world;
        const ClothChanges changes = crumpled.adapt(0, 12, adaptation < 10 ? 0.9 : 0.4);
        const Cloth& cloth = crumpled.world.cloths[0];
        const auto x = crumpled.world.positions_of(cloth);
        const auto old_x = before.positions_of(before.cloths[0]);

        double gain = 0.0;
        for (const ChangedPatch& patch :
             find_changed_patches({before.cloths[0], old_x}, {cloth, x}, changes, k_gravity)) {
            gain += patch.gain;
        }

        const double energy = test::surface_energy(before.cloths[0], old_x, k_gravity);
        EXPECT_NEAR(gain, test::surface_energy(cloth, x, k_gravity) - energy,
                    1e-10 * std::abs(energy));
    }
}

TEST_P(ChangedPatches, KnowHowTheForcesOnTheirVerticesChanged) {
    AdaptingWorld crumpled = sheets(SheetMotion::Crumple);
    for (int adaptation = 0; adaptation < 20; ++adaptation) {
        const World before = crumpled.world;
        const std::map<int, Vec3> old_forces = named_forces(crumpled);
        const ClothChanges changes = crumpled.adapt(0, 12, adaptation < 10 ? 0.9 : 0.4);
        const Cloth& cloth = crumpled.world.cloths[0];

        std::map<Index, Vec3> found;
        for (const ChangedPatch& patch : find_changed_patches(
                 {before.cloths[0], before.positions_of(before.cloths[0])},
                 {cloth, crumpled.world.positions_of(cloth)}, changes, k_gravity)) {
            for (const ChangedVertex& vertex : patch.vertices) {
                EXPECT_TRUE(found.emplace(vertex.vertex, vertex.force_change).second);
                const int name = crumpled.names()[static_cast<std::size_t>(vertex.vertex)];
                EXPECT_EQ(vertex.area_before > 0.0, old_forces.contains(name));
            }
        }

        const std::vector<Vec3> forces = elastic_forces(cloth, crumpled.world.positions_of(cloth));
        const std::vector<int> names = crumpled.names();
        for (const auto& [v, change] : found) {
            const auto old = old_forces.find(names[static_cast<std::size_t>(v)]);
            const Vec3 expected = forces[static_cast<std::size_t>(v)] -
                                  (old == old_forces.end() ? Vec3(Vec3::Zero()) : old->second);
            EXPECT_LT((change - expected).norm(), 1e-9 * (1.0 + expected.norm()));
        }
    }
}

/// Corners far from each other are no one patch.
TEST(FindChangedPatches, TellsPlacesApart) {
    AdaptingWorld flat(SheetMotion::Spin, 3);
    bool are_apart = false;
    for (int adaptation = 0; adaptation < 6; ++adaptation) {
        const World before = flat.world;
        const ClothChanges changes = flat.adapt(0, 3, 1.0);
        const Cloth& cloth = flat.world.cloths[0];
        const std::vector<ChangedPatch> patches =
            find_changed_patches({before.cloths[0], before.positions_of(before.cloths[0])},
                                 {cloth, flat.world.positions_of(cloth)}, changes, Vec3::Zero());
        are_apart = are_apart || patches.size() > 1;
        for (const ChangedPatch& patch : patches) {
            EXPECT_NEAR(patch.gain, 0.0, 1e-12); // flat and not strained
        }
    }
    EXPECT_TRUE(are_apart);
}

INSTANTIATE_TEST_SUITE_P(BendModels,
                         ChangedPatches,
                         testing::Values(BendModel::Quadratic, BendModel::MidEdge));

} // namespace weft
