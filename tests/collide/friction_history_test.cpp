#include "collide/contact_solver.h"
#include "support/contact_world.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace weft {

namespace {

constexpr double k_thickness = 1e-3;
constexpr double k_depth = 1e-4;

/// Three sheets of unlike meshes, one above the other, a little nearer than they rest.
class SheetsWithTransfers {
public:
    SheetsWithTransfers() {
        FabricParams fabric;
        fabric.thickness = k_thickness;
        for (const int cells : {4, 7, 5}) {
            const auto height = static_cast<double>(world.cloths.size()) * (k_thickness - k_depth);
            test::add_sheet(world, cells, 0.1, height, fabric);
        }
    }

    /// By a vertex of a cloth, against another cloth.
    void leave(std::size_t cloth, Index vertex, std::size_t partner, const Vec3& slip) {
        world.friction_history.push_back({transfer_key(world.cloths[cloth].first_vertex + vertex,
                                                       world.cloths[partner].first_vertex),
                                          k_thickness, slip, 0});
        std::sort(world.friction_history.begin(), world.friction_history.end(),
                  [](const auto& a, const auto& b) { return a.pair < b.pair; });
    }

    std::vector<Contact> find() {
        ContactSolver solver(world, {});
        std::vector<Contact> contacts;
        solver.find_contacts(world, std::vector<char>(world.vertex_count(), 0), 0.01, contacts);
        return contacts;
    }

    std::size_t object_of(Index v) const {
        return v < world.cloths[1].first_vertex ? 0 : v < world.cloths[2].first_vertex ? 1 : 2;
    }

    /// Slip of a cloth against another, as it sees it.
    Vec3 slip_between(std::size_t cloth, std::size_t partner, std::span<const Contact> contacts) {
        Vec3 sum = Vec3::Zero();
        for (const Contact& contact : contacts) {
            if (object_of(contact.pair[0]) == cloth && object_of(contact.pair[3]) == partner) {
                sum += contact.slip;
            } else if (object_of(contact.pair[0]) == partner &&
                       object_of(contact.pair[3]) == cloth) {
                sum -= contact.slip;
            }
        }
        return sum;
    }

    World world;
};

} // namespace

TEST(FrictionHistory, PairsFoundTakeOverAllOfTheSlip) {
    SheetsWithTransfers sheets;
    const Vec3 below(1e-5, 0.0, 2e-5);
    const Vec3 above(-3e-5, 0.0, 1e-5);
    sheets.leave(1, 27, 0, below);
    sheets.leave(1, 28, 0, 2.0 * below);
    sheets.leave(1, 27, 2, above);

    const std::vector<Contact> contacts = sheets.find();

    EXPECT_LT((sheets.slip_between(1, 0, contacts) - 3.0 * below).norm(), 1e-18);
    EXPECT_LT((sheets.slip_between(1, 2, contacts) - above).norm(), 1e-18);
    EXPECT_EQ(sheets.slip_between(0, 2, contacts), Vec3(Vec3::Zero()));
}

TEST(FrictionHistory, BothClothsMayLeaveSome) {
    SheetsWithTransfers sheets;
    const Vec3 slip(1e-5, 0.0, 2e-5);
    sheets.leave(1, 27, 0, slip);
    sheets.leave(0, 12, 1, -3.0 * slip); // the same way, as the other sees it

    const std::vector<Contact> contacts = sheets.find();

    EXPECT_LT((sheets.slip_between(1, 0, contacts) - 4.0 * slip).norm(), 1e-18);
}

TEST(FrictionHistory, PairsTakeByWeightAndDepthAndOnlyAtTheVertex) {
    SheetsWithTransfers sheets;
    const Vec3 slip(1e-5, 0.0, 0.0);
    sheets.leave(1, 27, 0, slip);
    const Index v = sheets.world.cloths[1].first_vertex + 27;

    const std::vector<Contact> contacts = sheets.find();

    const auto claim = [&](const Contact& contact) {
        double weight = 0.0;
        if (sheets.object_of(contact.pair[0]) + sheets.object_of(contact.pair[3]) == 1) {
            for (std::size_t i = 0; i < 4; ++i) {
                weight += contact.pair[i] == v ? contact.weights[i] : 0.0;
            }
        }
        return weight * std::max(0.0, contact.rest_gap - contact.gap);
    };
    double claims = 0.0;
    int takers = 0;
    for (const Contact& contact : contacts) {
        claims += std::abs(claim(contact));
        takers += claim(contact) != 0.0;
    }
    EXPECT_GT(takers, 2);
    for (const Contact& contact : contacts) {
        EXPECT_LT((contact.slip - claim(contact) / claims * slip).norm(), 1e-18);
    }
}

TEST(FrictionHistory, PairsThatAreRememberedKeepTheirOwn) {
    SheetsWithTransfers sheets;
    const std::vector<Contact> before = sheets.find();
    const Index v = sheets.world.cloths[1].first_vertex + 27;
    const auto own = std::find_if(before.begin(), before.end(), [&](const Contact& contact) {
        return contact.kind == PairKind::VertexFace && contact.pair[0] == v &&
               sheets.object_of(contact.pair[3]) == 0;
    });
    ASSERT_NE(own, before.end());
    const Vec3 known(0.0, 0.0, 7e-6);
    sheets.world.friction_history.push_back({own->pair, k_thickness, known, 0});
    sheets.leave(1, 27, 0, Vec3(1e-5, 0.0, 0.0));

    const std::vector<Contact> contacts = sheets.find();

    const auto same = std::find_if(contacts.begin(), contacts.end(),
                                   [&](const Contact& one) { return one.pair == own->pair; });
    EXPECT_LT((same->slip - known).norm(), 1e-18);
    EXPECT_LT((sheets.slip_between(1, 0, contacts) - known - Vec3(1e-5, 0.0, 0.0)).norm(), 1e-18);
}

/// Its partner is only named by a vertex, which has no part in what is remembered.
TEST(FrictionHistory, RestGapsPassToThePairsOfTheVertexAlone) {
    SheetsWithTransfers sheets;
    sheets.leave(1, 27, 0, Vec3::Zero());
    const Index v = sheets.world.cloths[1].first_vertex + 27;

    for (const Contact& contact : sheets.find()) {
        const bool is_there =
            std::find(contact.pair.begin(), contact.pair.end(), v) != contact.pair.end();
        // others start from where they are, and part by a share of the rest
        EXPECT_EQ(contact.rest_gap > contact.gap + 0.5 * k_depth, is_there);
    }
}

} // namespace weft
