#include "forces/air.h"
#include "forces/bending.h"
#include "forces/constant_bending.h"
#include "forces/membrane.h"
#include "support/changing_sheet.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {

using namespace test;

namespace {

ChangingSheet changing_sheet(BendModel model, unsigned seed) {
    return {irregular_sheet(7, 5, 0.7, 0.5, 0.2, seed),
            {.bend_stiffness = 1e-4, .damping = {0.1, 0.02}},
            model,
            seed};
}

std::vector<Vec3> bent(const ChangingSheet& sheet) {
    std::vector<Vec3> x;
    for (const Vec2& m : sheet.points()) {
        x.emplace_back(1.1 * m.x(), 0.05 * std::sin(20.0 * m.x() + 5.0 * m.y()), m.y());
    }
    return x;
}

std::vector<Vec3> moving(const ChangingSheet& sheet) {
    std::vector<Vec3> v;
    for (const Vec2& m : sheet.points()) {
        v.emplace_back(m.x() * m.y(), std::cos(9.0 * m.x()), m.y() - m.x());
    }
    return v;
}

/// Everything that the set says of itself, as one row of numbers.
template <typename Elements>
std::vector<double> spoken(const Elements& elements, const ChangingSheet& sheet) {
    constexpr auto blocks_each = at(block_count(Elements::k_nodes));
    std::vector<Vec3> forces(elements.nodes().size());
    std::vector<Mat3> blocks(elements.size() * blocks_each);
    elements.evaluate(bent(sheet), moving(sheet), {1e-4, 1e-2}, forces, blocks);
    std::vector<double> row(elements.nodes().begin(), elements.nodes().end());
    for (const Vec3& f : forces) {
        row.insert(row.end(), f.data(), f.data() + 3);
    }
    for (const Mat3& b : blocks) {
        row.insert(row.end(), b.data(), b.data() + 9);
    }
    return row;
}

std::vector<double> spoken(const ConstantBending& bending, const ChangingSheet& sheet) {
    std::vector<Vec3> forces(bending.nodes().size());
    bending.forces(bent(sheet), forces);
    std::vector<double> row(bending.nodes().begin(), bending.nodes().end());
    row.insert(row.end(), bending.stiffness().begin(), bending.stiffness().end());
    for (const Vec3& f : forces) {
        row.insert(row.end(), f.data(), f.data() + 3);
    }
    row.push_back(bending.energy(bent(sheet)));
    return row;
}

/// Slots of elements whose row of k numbers differs, or that are new.
template <typename T>
std::vector<Index> different(std::span<const T> before, std::span<const T> now, std::size_t k) {
    std::vector<Index> slots;
    for (std::size_t e = 0; e < now.size() / k; ++e) {
        if ((e + 1) * k > before.size() ||
            !std::equal(&now[e * k], &now[e * k] + k, &before[e * k])) {
            slots.push_back(static_cast<Index>(e));
        }
    }
    return slots;
}

/// Makes random changes, and expects the set that was updated to be the set made afresh.
template <typename Make> void expect_same_as_fresh(BendModel model, const Make& make) {
    for (unsigned seed = 1; seed <= 6; ++seed) {
        ChangingSheet sheet = changing_sheet(model, seed);
        auto updated = make(sheet.cloth());
        for (int round = 0; round < 12; ++round) {
            const std::vector<Index> before(updated.nodes().begin(), updated.nodes().end());
            const ClothChanges changes = sheet.change(8, round < 6 ? 0.8 : 0.1);

            const std::vector<Index> slots = updated.remesh(sheet.cloth(), changes);

            const auto fresh = make(sheet.cloth());
            ASSERT_EQ(spoken(updated, sheet), spoken(fresh, sheet));
            ASSERT_TRUE(std::is_sorted(slots.begin(), slots.end()));
            const std::size_t k = fresh.nodes().size() / fresh.size();
            for (const Index slot : different<Index>(before, fresh.nodes(), k)) {
                ASSERT_TRUE(std::binary_search(slots.begin(), slots.end(), slot));
            }
        }
    }
}

} // namespace

TEST(ChangedElements, MembraneUpdatedIsTheMembraneMadeAfresh) {
    expect_same_as_fresh(BendModel::MidEdge, [](const Cloth& c) { return MembraneElements(c); });
}

TEST(ChangedElements, AirUpdatedIsTheAirMadeAfresh) {
    expect_same_as_fresh(BendModel::MidEdge, [](const Cloth& c) {
        return AirElements(c, {.wind = {1.0, 0.0, 2.0}, .air_density = 1.2});
    });
}

TEST(ChangedElements, BendDampingUpdatedIsTheDampingMadeAfresh) {
    expect_same_as_fresh(BendModel::MidEdge, [](const Cloth& c) { return BendDampingElements(c); });
}

TEST(ChangedElements, BendingUpdatedIsTheBendingMadeAfresh) {
    for (const BendModel model : {BendModel::Quadratic, BendModel::MidEdge}) {
        expect_same_as_fresh(model, [](const Cloth& c) { return ConstantBending(c); });
    }
}

TEST(ChangedElements, FewAreTouchedByFewChanges) {
    ChangingSheet sheet({union_jack_sheet(40, 40, 1.0, 1.0)}, {.bend_stiffness = 1e-4},
                        BendModel::MidEdge, 1);
    ConstantBending bending(sheet.cloth());

    const ClothChanges changes = sheet.change(1, 1.0);

    EXPECT_LE(changes.triangles.size(), 3U);
    EXPECT_LE(bending.remesh(sheet.cloth(), changes).size(), 8U); // a flip: two and six around them
}

TEST(ChangedElements, AirForgetsWhereItWasLinearised) {
    ChangingSheet sheet = changing_sheet(BendModel::MidEdge, 1);
    const SceneParams scene{.air_density = 1.2};
    AirElements updated(sheet.cloth(), scene);
    updated.linearise_at(std::vector<Vec3>(sheet.points().size(), Vec3(1, 2, 3)));

    updated.remesh(sheet.cloth(), sheet.change(8));

    EXPECT_EQ(spoken(updated, sheet), spoken(AirElements(sheet.cloth(), scene), sheet));
}

} // namespace weft
