#include "support/changing_world.h"

#include <cmath>

namespace weft::test {

namespace {

constexpr std::size_t k_threads = 7;

AttachedPair thread_between(const std::array<Index, 3>& v) {
    return {.vertices = {v[0], v[1], v[2], k_no_index, k_no_index, k_no_index},
            .weights = {1.0, -0.25, -0.75, 0.0, 0.0, 0.0},
            .attachment = 0,
            .limit = 0.5};
}

} // namespace

ChangingWorld::ChangingWorld(int sheet_count, unsigned seed) : random_(seed) {
    for (int i = 0; i < sheet_count; ++i) {
        sheets_.emplace_back(
            irregular_sheet(6 + i, 5, 0.6, 0.5, 0.2, seed + static_cast<unsigned>(i)),
            FabricParams{.bend_stiffness = 1e-4, .damping = {0.1, 0.01}},
            i % 2 == 0 ? BendModel::MidEdge : BendModel::Quadratic, seed);
    }
    world_.attachments.push_back({.name = "threads"});
    rebuild_world();
}

std::vector<ClothChanges> ChangingWorld::change(std::span<const int> edits, double growth) {
    std::vector<ClothChanges> changes;
    for (std::size_t i = 0; i < sheets_.size(); ++i) {
        changes.push_back(sheets_[i].change(edits[i], growth));
    }
    rebuild_world();
    return changes;
}

void ChangingWorld::rebuild_world() {
    world_.cloths.clear();
    world_.positions.clear();
    world_.velocities.clear();
    world_.masses.clear();
    for (ChangingSheet& sheet : sheets_) {
        sheet.cloth().first_vertex = static_cast<Index>(world_.positions.size());
        const double height = 0.1 * static_cast<double>(world_.cloths.size());
        world_.cloths.push_back(sheet.cloth());
        for (std::size_t i = 0; i < sheet.points().size(); ++i) {
            const Vec2& m = sheet.points()[i];
            world_.positions.emplace_back(
                1.02 * m.x(), height + 0.03 * std::sin(20.0 * m.x() + 5.0 * m.y()), m.y());
            world_.velocities.emplace_back(m.x() * m.y(), std::cos(9.0 * m.x()), m.y() - m.x());
            world_.masses.push_back(0.2 * sheet.cloth().rest_areas[i]);
        }
    }
    world_.previous_positions = world_.positions;
    world_.previous_velocities = world_.velocities;
    world_.attached_pairs.clear();
    std::uniform_int_distribution<Index> any(0, static_cast<Index>(world_.vertex_count()) - 1);
    while (world_.attached_pairs.size() < k_threads) {
        const std::array<Index, 3> v{any(random_), any(random_), any(random_)};
        if (v[0] != v[1] && v[1] != v[2] && v[2] != v[0]) {
            world_.attached_pairs.push_back(thread_between(v));
        }
    }
    world_.attached_states.assign(k_threads, {.start_gap = 0.05});
}

} // namespace weft::test
