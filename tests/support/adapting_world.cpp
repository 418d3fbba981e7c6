#include "support/adapting_world.h"

#include "adapt/adaptive_cloth.h"
#include "support/worlds.h"

#include <algorithm>
#include <numbers>
#include <numeric>

namespace weft::test {

namespace {

Scene three_sheets() {
    Scene scene;
    for (const int cells : {6, 3, 5}) {
        ClothParams sheet = record_sheet(cells);
        sheet.name = "sheet" + std::to_string(cells);
        sheet.placement.translate = {0.3, 0.1 * cells, -0.7};
        sheet.adapt.levels = cells == 3 ? 0 : 3;
        scene.cloths.push_back(sheet);
    }
    PinParams side;
    side.has_box = true;
    side.box_min = {-1.0, -1.0, -1.21};
    side.box_max = {2.0, 2.0, -1.19};
    scene.cloths.back().pins.push_back(side);
    return scene;
}

/// The sheets are flat and nothing is attached yet, so no edge and no triangle is kept.
void make_adaptive(World& world) {
    for (Cloth& cloth : world.cloths) {
        if (cloth.params.adapt.levels > 0) {
            make_refinement(cloth);
            const auto x = world.positions_of(cloth);
            cloth.refinement.start.assign(x.begin(), x.end());
        }
    }
}

} // namespace

AdaptingWorld::AdaptingWorld(SheetMotion motion, unsigned seed)
    : world(build_quietly(three_sheets())), random(seed) {
    make_adaptive(world);
    set_motion(motion);
    name_all();
    for (const Cloth& cloth : world.cloths) {
        meshes_.emplace_back();
        if (!cloth.refinement.empty()) {
            meshes_.back().emplace(cloth);
        }
    }
    const auto count = static_cast<Index>(world.vertex_count());
    for (Index v = 0; v + 3 * 7 < count; v += 2) { // the fourth is an obstacle's
        const std::array<Index, 4> pair{v, v + 7, v + 3 * 7, count + v};
        world.friction_history.push_back({pair, 1e-3 * v, noise(1e-4), v % 4 == 0});
    }
    for (Index v = 0; v < 7; ++v) { // cloths 0, 1 and 2: imported vertices alone
        world.attached_pairs.push_back(
            {{v, v + 1, v + 49, count - 1 - v, k_no_index, k_no_index}, {}, 0, 0.0});
    }
    world.attached_states.resize(world.attached_pairs.size());
}

Vec3 AdaptingWorld::noise(double size) {
    std::uniform_real_distribution<double> uniform(-size, size);
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    return {x, y, z};
}

void AdaptingWorld::set_motion(SheetMotion motion) {
    constexpr double dt = 0.01;
    const Vec3 drift = noise(1.0);
    const Vec3 spin = noise(3.0);
    for (const Cloth& cloth : world.cloths) {
        const Vec3 centre = cloth.params.placement.translate;
        const double crumple = motion == SheetMotion::Crumple ? 0.25 / 6.0 : 0.0;
        for (std::size_t i = at(cloth.first_vertex);
             i < at(cloth.first_vertex + cloth.vertex_count); ++i) {
            Vec3& x = world.positions[i];
            const double phase = 2.0 * std::numbers::pi * (x.x() + 0.7 * x.z());
            if (motion != SheetMotion::Spin) {
                x.y() += 0.05 * std::sin(phase);
            }
            x += noise(crumple);
            world.velocities[i] = drift + spin.cross(x - centre) + noise(6.0 * crumple);
            if (motion != SheetMotion::Spin) {
                world.velocities[i].y() += 0.5 * std::cos(phase);
            }
            world.previous_positions[i] = x - dt * world.velocities[i];
            world.previous_velocities[i] = world.velocities[i] - dt * noise(1.0 + crumple);
        }
    }
    world.history_dt = dt;
}

void AdaptingWorld::name_all() {
    for (const Cloth& cloth : world.cloths) {
        std::vector<int>& names = names_.emplace_back();
        for (Index v = 0; v < cloth.vertex_count; ++v) {
            const Vec3& x = world.positions[at(cloth.first_vertex + v)];
            const bool is_adaptive = !cloth.refinement.empty();
            const Vec3& previous = world.previous_positions[at(cloth.first_vertex + v)];
            places_[next_name_] = {x, previous, is_adaptive ? cloth.refinement.start[at(v)] : x};
            names.push_back(next_name_++);
        }
    }
}

AdaptationHooks AdaptingWorld::follow(std::size_t index, StateTransfer& transfer) {
    AdaptationHooks hooks;
    hooks.insert = [this, index, &transfer](const VertexParents& place) {
        transfer.insert(place);
        Place mean{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
        for (std::size_t k = 0; k < 3 && place.parents[k] != k_no_index; ++k) {
            const Place& parent = places_.at(names_[index][at(place.parents[k])]);
            mean.x += place.weights[k] * parent.x;
            mean.previous += place.weights[k] * parent.previous;
            mean.start += place.weights[k] * parent.start;
        }
        places_[next_name_] = mean;
        names_[index].push_back(next_name_++);
    };
    hooks.remove = [&transfer](const VertexParents& place) { transfer.remove(place); };
    hooks.move = [this, index, &transfer](Index from, Index to) {
        transfer.move(from, to);
        names_[index][at(to)] = names_[index][at(from)];
    };
    return hooks;
}

ClothChanges AdaptingWorld::adapt(std::size_t index, int edits, double growth) {
    Cloth& cloth = world.cloths[index];
    Sqrt3Mesh& mesh = *meshes_[index];
    StateTransfer transfer(world, cloth);
    mesh.begin(
        cloth, follow(index, transfer),
        {.max_level = cloth.params.adapt.levels, .adaptation = ++cloth.refinement.adaptations});
    for (int k = 0; k < edits; ++k) {
        const auto t = static_cast<Index>(random() % cloth.triangles.size());
        const auto v = static_cast<Index>(random() % at(cloth.vertex_count));
        if (std::uniform_real_distribution<double>(0.0, 1.0)(random) < growth) {
            if (cloth.triangles[at(t)][0] != k_no_index) {
                mesh.refine(t);
            }
        } else if (mesh.can_remove(v)) {
            mesh.remove(v);
        }
    }
    const ClothChanges changes = mesh.finish();
    transfer.finish(world, index, changes);
    names_[index].resize(at(cloth.vertex_count));
    return changes;
}

void AdaptingWorld::coarsen_all() {
    for (std::size_t c = 0; c < world.cloths.size(); ++c) {
        while (!world.cloths[c].refinement.vertices.empty()) {
            adapt(c, 100, 0.0);
        }
    }
}

std::vector<int> AdaptingWorld::names() const {
    std::vector<int> all;
    for (const std::vector<int>& names : names_) {
        all.insert(all.end(), names.begin(), names.end());
    }
    return all;
}

PatchMomentum momentum_of(const World& world, const Cloth& cloth, const Vec3& about) {
    PatchMomentum sum;
    for (std::size_t i = at(cloth.first_vertex); i < at(cloth.first_vertex + cloth.vertex_count);
         ++i) {
        sum.add(world.masses[i], world.positions[i] - about, world.velocities[i]);
    }
    return sum;
}

double rms_speed(const World& world, const Cloth& cloth) {
    double sum = 0.0;
    for (const Vec3& v : world.velocities_of(cloth)) {
        sum += v.squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(cloth.vertex_count));
}

} // namespace weft::test
