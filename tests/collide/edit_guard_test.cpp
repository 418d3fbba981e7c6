#include "collide/contact_solver.h"
#include "collide/edit_guard.h"
#include "support/contact_world.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

/// Two level sheets, 0.1 m wide, 4 mm apart over a floor 1 m below, after one substep at rest.
class GuardedSheets : public testing::Test {
protected:
    static constexpr double k_gap = 4e-3;

    GuardedSheets() {
        FabricParams fabric;
        fabric.thickness = 1e-3;
        test::add_sheet(world_, 4, 0.1, 0.0, fabric).name = "lower";
        test::add_sheet(world_, 4, 0.1, k_gap, fabric).name = "upper";
        test::add_floor(world_, 1.0, -1.0);
        solver_.emplace(world_, ContactParams{});
        std::vector<Contact> contacts;
        std::vector<Vec3> still(world_.vertex_count(), Vec3::Zero());
        const std::vector<char> held(world_.vertex_count(), 0);
        solver_->find_contacts(world_, held, 0.01, contacts);
        solver_->resolve(world_, still, held, 0.01, contacts);
    }

    /// Of the lower sheet's inner edge number e: its ends and apexes, the second apex raised.
    bool may_flip(EditGuard& guard, std::size_t e, double height) const {
        const Cloth& lower = world_.cloths[0];
        const MeshEdge& edge = inner_edge(e);
        const std::array<Index, 4> v{edge.v[0], edge.v[1], edge.apex[0], edge.apex[1]};
        std::array<Vec3, 4> x;
        for (std::size_t k = 0; k < 4; ++k) {
            x[k] = world_.positions[static_cast<std::size_t>(lower.first_vertex + v[k])];
        }
        x[3].y() += height;
        return guard.may_sweep(0, x, v);
    }

    const MeshEdge& inner_edge(std::size_t number) const {
        for (const MeshEdge& edge : world_.cloths[0].topology.edges) {
            if (!edge.is_boundary() && number-- == 0) {
                return edge;
            }
        }
        throw std::logic_error("no such edge");
    }

    World world_;
    std::optional<ContactSolver> solver_;
};

} // namespace

TEST_F(GuardedSheets, LetsFlatAndFreeEditsBe) {
    EditGuard guard = *solver_->guard_edits();

    EXPECT_TRUE(may_flip(guard, 3, 0.0));
    EXPECT_TRUE(may_flip(guard, 3, 0.9 * k_gap - 0.3e-3)); // leaves a third of the thickness
}

TEST_F(GuardedSheets, RefusesWhatComesNearerThanContactAllows) {
    EditGuard guard = *solver_->guard_edits();

    EXPECT_FALSE(may_flip(guard, 3, k_gap - 0.1e-3));
    EXPECT_FALSE(may_flip(guard, 3, 2.0 * k_gap));
}

TEST_F(GuardedSheets, RefusesWhatMeetsAnotherEditBetween) {
    EditGuard guard = *solver_->guard_edits();
    ASSERT_TRUE(may_flip(guard, 3, 0.5 * k_gap));
    const MeshEdge& edge = inner_edge(3);
    const Cloth& upper = world_.cloths[1];
    std::array<Vec3, 4> x;
    std::array<Index, 4> v{edge.v[0], edge.v[1], edge.apex[0], edge.apex[1]};
    for (std::size_t k = 0; k < 4; ++k) { // the same place of the upper sheet, sunk to the middle
        x[k] = world_.positions[static_cast<std::size_t>(upper.first_vertex + v[k])];
    }
    x[3].y() -= 0.6 * k_gap;

    EXPECT_FALSE(guard.may_sweep(1, x, v));
}

TEST_F(GuardedSheets, SeesAChangedTriangleThatCrosses) {
    const EditGuard guard = *solver_->guard_edits();
    const Cloth& lower = world_.cloths[0];
    std::vector<Vec3> x(world_.positions.begin(), world_.positions.begin() + lower.vertex_count);
    ClothChanges changes;
    changes.triangles = {5};
    EXPECT_FALSE(guard.crosses(0, lower, x, changes));

    x[static_cast<std::size_t>(lower.triangles[5][0])].y() += 2.0 * k_gap;
    EXPECT_TRUE(guard.crosses(0, lower, x, changes));
}

TEST_F(GuardedSheets, TakesAMovedVertexForWhatItWas) {
    // Triangle 5 is another one now, whose corner 0 stands in a new slot: it still shares that
    // vertex with its neighbours, and does not cross them there.
    const EditGuard guard = *solver_->guard_edits();
    Cloth lower = world_.cloths[0];
    std::vector<Vec3> x(world_.positions.begin(), world_.positions.begin() + lower.vertex_count);
    const Index old = lower.triangles[5][0];
    x.push_back(x[static_cast<std::size_t>(old)]);
    lower.triangles[5][0] = lower.vertex_count;
    ClothChanges changes;
    changes.triangles = {5};
    changes.vertices = {{lower.vertex_count, old}};

    EXPECT_FALSE(guard.crosses(0, lower, x, changes));
}

TEST(EditGuard, IsNotThereWithoutContact) {
    World world;
    test::add_sheet(world, 2, 0.1, 0.0, {});
    ContactParams off;
    off.enabled = false;

    EXPECT_FALSE(ContactSolver(world, off).guard_edits());
}

} // namespace weft
