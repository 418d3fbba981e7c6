#include "adapt/state_transfer.h"

#include "adapt/change_log.h"
#include "base/disjoint_sets.h"
#include "state/rigid_motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace weft {

namespace {

/// Steps across edges by which a patch of changed triangles is grown before its momenta are
/// restored. Fewer: what few vertices lose of inertia turns them visibly; more: what is lost in one
/// place moves others.
constexpr int k_patch_steps = 8;

/// The triangles given and those around them, the order of no meaning.
std::vector<Index> grow(const Cloth& cloth, std::vector<Index> triangles) {
    std::vector<char> is_in(cloth.triangles.size(), 0);
    for (const Index t : triangles) {
        is_in[at(t)] = 1;
    }
    std::size_t begin = 0;
    for (int step = 0; step < k_patch_steps; ++step) {
        const std::size_t end = triangles.size();
        for (; begin < end; ++begin) {
            for (const Index e : cloth.topology.triangle_edges[at(triangles[begin])]) {
                for (const Index t : cloth.topology.edges[at(e)].triangle) {
                    if (t != k_no_index && is_in[at(t)] == 0) {
                        is_in[at(t)] = 1;
                        triangles.push_back(t);
                    }
                }
            }
        }
    }
    return triangles;
}

} // namespace

StateTransfer::StateTransfer(const World& world, const Cloth& cloth)
    : obstacles_(&world.obstacles), origin_(world.positions[at(cloth.first_vertex)]),
      states_(at(cloth.vertex_count)), old_count_(states_.size()) {
    const bool has_history = !world.previous_positions.empty();
    for (std::size_t i = 0; i < states_.size(); ++i) {
        const std::size_t v = at(cloth.first_vertex) + i;
        states_[i].x = world.positions[v];
        states_[i].v = world.velocities[v];
        states_[i].previous_x = has_history ? world.previous_positions[v] : states_[i].x;
        states_[i].previous_v = has_history ? world.previous_velocities[v] : states_[i].v;
        states_[i].start = cloth.refinement.start[i];
        states_[i].mass = world.masses[v];
        states_[i].former = static_cast<Index>(i);
    }
    for (const Pin& pin : world.pins) {
        const Index v = pin.vertex - cloth.first_vertex;
        if (v >= 0 && v < cloth.vertex_count) {
            states_[at(v)].pin = pin;
        }
    }
    find_fixed(world, cloth);
}

void StateTransfer::find_fixed(const World& world, const Cloth& cloth) {
    const auto fix = [&](Index vertex) {
        const Index v = vertex - cloth.first_vertex;
        if (v >= 0 && v < cloth.vertex_count) {
            states_[at(v)].is_fixed_for_remesh = true;
        }
    };
    for (const Pin& pin : world.pins) {
        fix(pin.vertex);
    }
    for (const AttachedPair& pair : world.attached_pairs) {
        std::for_each(pair.vertices.begin(), pair.vertices.end(), fix);
    }
    for (const FrictionHistory& memory : world.friction_history) {
        std::for_each(memory.pair.begin(), memory.pair.end() - (is_transfer(memory) ? 1 : 0), fix);
    }
}

void StateTransfer::insert(const VertexParents& place) {
    assert(place.vertex == static_cast<Index>(states_.size()));
    VertexState state{};
    for (Vec3 VertexState::*value : {&VertexState::x, &VertexState::v, &VertexState::previous_x,
                                     &VertexState::previous_v, &VertexState::start}) {
        Vec3 mean = Vec3::Zero();
        for (std::size_t k = 0; k < 3; ++k) {
            if (place.parents[k] != k_no_index) {
                mean += place.weights[k] * states_[at(place.parents[k])].*value;
            }
        }
        state.*value = mean;
    }
    state.is_fixed_for_remesh =
        std::all_of(place.parents.begin(), place.parents.end(), [&](Index parent) {
            return parent == k_no_index || states_[at(parent)].is_fixed_for_remesh;
        });
    state.pin = common_pin(place);
    if (state.pin) {
        state.pin->start = state.start;
        const Index obstacle = state.pin->anchor.obstacle;
        if (obstacle != k_no_index) {
            state.pin->anchor = anchor_to((*obstacles_)[at(obstacle)], obstacle, state.start);
        }
    }
    state.former = place.vertex;
    states_.push_back(std::move(state));
    inserted_.push_back(place);
}

/// The pin of the first parent when all are held by the same `[[cloth.pin]]`.
std::optional<Pin> StateTransfer::common_pin(const VertexParents& place) const {
    const std::optional<Pin>& first = states_[at(place.parents[0])].pin;
    const bool all = std::all_of(place.parents.begin(), place.parents.end(), [&](Index parent) {
        return parent == k_no_index ||
               (first && states_[at(parent)].pin && states_[at(parent)].pin->group == first->group);
    });
    return all ? first : std::nullopt;
}

void StateTransfer::remove(const VertexParents& place) {
    const VertexState& gone = states_[at(place.vertex)];
    PatchMomentum left = gone.left;
    left.add(gone.mass, gone.x - origin_, gone.v);
    states_[at(place.parents[0])].left += left;
    PatchMomentum left_change = gone.left_change;
    left_change.add(gone.mass, gone.x - origin_, gone.v - gone.previous_v);
    states_[at(place.parents[0])].left_change += left_change;
}

void StateTransfer::move(Index from, Index to) {
    states_[at(to)] = std::move(states_[at(from)]);
}

void StateTransfer::shift(Index v, const Vec3& x) {
    VertexState& state = states_[at(v)];
    const Vec3 way = x - state.x;
    // Angular momentum about the old place, less that which finish() will take it to have had
    // there.
    state.left.angular -= state.mass * way.cross(state.v);
    state.left_change.angular -= state.mass * way.cross(state.v - state.previous_v);
    state.x = x;
    state.previous_x += way;
}

std::vector<Vec3> StateTransfer::positions(const Cloth& cloth) const {
    std::vector<Vec3> x;
    for (Index v = 0; v < cloth.vertex_count; ++v) {
        x.push_back(position(v));
    }
    return x;
}

void StateTransfer::set_masses(const Cloth& cloth, const ClothChanges& changes) {
    masses_.resize(states_.size());
    for (std::size_t i = 0; i < states_.size(); ++i) {
        masses_[i] = states_[i].mass;
    }
    for (const Index v : changes.masses) {
        masses_[at(v)] = cloth.params.fabric.area_density * cloth.rest_areas[at(v)];
    }
}

/// Each connected set of triangles around changed ones on its own.
void StateTransfer::correct_velocities(const Cloth& cloth, const ClothChanges& changes) {
    DisjointSets patches(states_.size());
    std::vector<char> is_touched(states_.size(), 0);
    for (const Index t : grow(cloth, changes.triangles)) {
        const Triangle& corners = cloth.triangles[at(t)];
        patches.join(corners[0], corners[1]);
        patches.join(corners[1], corners[2]);
        for (const Index v : corners) {
            is_touched[at(v)] = 1;
        }
    }
    // A set is named after its least vertex, so that it is met there first.
    std::vector<std::vector<Index>> vertices;
    std::vector<std::size_t> place(states_.size(), 0);
    for (std::size_t v = 0; v < states_.size(); ++v) {
        if (is_touched[v] == 0) {
            continue;
        }
        const std::size_t name = at(patches.find(static_cast<Index>(v)));
        if (name == v) {
            place[v] = vertices.size();
            vertices.emplace_back();
        }
        vertices[place[name]].push_back(static_cast<Index>(v));
    }
    for (const std::vector<Index>& patch : vertices) {
        correct_patch(patch);
    }
}

void StateTransfer::correct_patch(std::span<const Index> patch) {
    PatchMomentum before, before_change;
    std::vector<double> m;
    std::vector<Vec3> x, v, change;
    for (const Index i : patch) {
        const VertexState& state = states_[at(i)];
        m.push_back(masses_[at(i)]);
        x.push_back(state.x - origin_);
        v.push_back(state.v);
        change.push_back(state.v - state.previous_v);
        before += state.left;
        before.add(state.mass, x.back(), v.back());
        before_change += state.left_change;
        before_change.add(state.mass, x.back(), change.back());
    }
    restore_momentum(before, m, x, v);
    restore_momentum(before_change, m, x, change);
    for (std::size_t k = 0; k < patch.size(); ++k) {
        states_[at(patch[k])].v = v[k];
        states_[at(patch[k])].previous_v = v[k] - change[k];
    }
}

/// Takes it from the world as it was before the adaptation.
FrictionTransfer StateTransfer::begin_friction_transfer(World& world,
                                                        const Cloth& cloth,
                                                        const ClothChanges& changes) const {
    std::vector<char> is_changed(old_count_, 1); // if it is found nowhere
    for (const VertexState& state : states_) {
        if (at(state.former) < old_count_) {
            is_changed[at(state.former)] = 0;
        }
    }
    for (const Index t : changes.triangles) {
        for (const Index v : cloth.triangles[at(t)]) {
            if (at(states_[at(v)].former) < old_count_) {
                is_changed[at(states_[at(v)].former)] = 1;
            }
        }
    }
    FrictionTransfer transfer(world, cloth.first_vertex, is_changed);
    for (const VertexParents& place : inserted_) {
        transfer.inherit(place);
    }
    return transfer;
}

void StateTransfer::end_friction_transfer(World& world, const FrictionTransfer& transfer) const {
    std::vector<Index> former;
    for (const VertexState& state : states_) {
        former.push_back(state.former);
    }
    transfer.leave(world, former, masses_);
}

void StateTransfer::finish(World& world, std::size_t index, const ClothChanges& changes) {
    Cloth& cloth = world.cloths[index];
    states_.resize(at(cloth.vertex_count));
    set_masses(cloth, changes);
    correct_velocities(cloth, changes);
    const FrictionTransfer transfer = begin_friction_transfer(world, cloth, changes);
    renumber_world(world, index, old_count_, changes);
    end_friction_transfer(world, transfer);
    const bool has_history = !world.previous_positions.empty();
    cloth.refinement.start.resize(states_.size());
    for (std::size_t i = 0; i < states_.size(); ++i) {
        const std::size_t v = at(cloth.first_vertex) + i;
        world.positions[v] = states_[i].x;
        world.velocities[v] = states_[i].v;
        world.masses[v] = masses_[i];
        if (has_history) {
            world.previous_positions[v] = states_[i].previous_x;
            world.previous_velocities[v] = states_[i].previous_v;
        }
        cloth.refinement.start[i] = states_[i].start;
        if (states_[i].pin) {
            world.pins.push_back(*states_[i].pin);
            world.pins.back().vertex = static_cast<Index>(v);
        }
    }
    std::sort(world.pins.begin(), world.pins.end(),
              [](const Pin& a, const Pin& b) { return a.vertex < b.vertex; });
}

namespace {

/// Fraction of a patch's distance from the origin below which its width is rounding: vertices in a
/// point.
constexpr double k_least_width = 1e-12;

/// Least factor by which velocities other than those of a rigid motion are scaled. Smaller: they
/// jump where masses came nearer to the axis of a spin, which takes energy that cannot be taken off
/// it; larger: adaptations give cloth energy.
constexpr double k_least_scale = 0.98;

/// A rigid motion about a centre.
struct PatchMotion {
    Vec3 centre, velocity, spin;

    Vec3 velocity_at(const Vec3& x) const { return velocity + spin.cross(x - centre); }
};

Mat3 inertia_about(const Vec3& centre, std::span<const double> m, std::span<const Vec3> x) {
    Mat3 inertia = Mat3::Zero();
    for (std::size_t i = 0; i < m.size(); ++i) {
        const Vec3 r = x[i] - centre;
        inertia += m[i] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    }
    return inertia;
}

PatchMomentum
momentum_of(std::span<const double> m, std::span<const Vec3> x, std::span<const Vec3> v) {
    PatchMomentum momentum;
    for (std::size_t i = 0; i < m.size(); ++i) {
        momentum.add(m[i], x[i], v[i]);
    }
    return momentum;
}

} // namespace

void PatchMomentum::add(double m, const Vec3& x, const Vec3& v) {
    mass += m;
    linear += m * v;
    angular += m * x.cross(v);
    kinetic += 0.5 * m * v.squaredNorm();
}

PatchMomentum& PatchMomentum::operator+=(const PatchMomentum& other) {
    mass += other.mass;
    linear += other.linear;
    angular += other.angular;
    kinetic += other.kinetic;
    return *this;
}

void restore_momentum(const PatchMomentum& before,
                      std::span<const double> m,
                      std::span<const Vec3> x,
                      std::span<Vec3> v) {
    PatchMomentum now = momentum_of(m, x, v);
    Vec3 centre = Vec3::Zero();
    for (std::size_t i = 0; i < m.size(); ++i) {
        centre += m[i] / now.mass * x[i];
    }
    const Mat3 inertia = inertia_about(centre, m, x);
    const double least_inertia = now.mass * k_least_width * k_least_width * centre.squaredNorm();
    const auto spin_of = [&](const PatchMomentum& momentum) {
        return weft::spin_of(inertia, momentum.angular - centre.cross(momentum.linear),
                             least_inertia);
    };
    const PatchMomentum missing{0.0, before.linear - now.linear, before.angular - now.angular, 0.0};
    const PatchMotion correction{centre, missing.linear / now.mass, spin_of(missing)};
    for (std::size_t i = 0; i < m.size(); ++i) {
        v[i] += correction.velocity_at(x[i]);
    }

    now = momentum_of(m, x, v);
    if (now.kinetic <= before.kinetic) {
        return;
    }
    const PatchMotion rigid{centre, now.linear / now.mass, spin_of(now)};
    double fluctuation = 0.0;
    for (std::size_t i = 0; i < m.size(); ++i) {
        fluctuation += 0.5 * m[i] * (v[i] - rigid.velocity_at(x[i])).squaredNorm();
    }
    if (!(fluctuation > 0.0)) {
        return;
    }
    const double excess = now.kinetic - before.kinetic;
    const double scale =
        std::max(k_least_scale, std::sqrt(std::max(0.0, 1.0 - excess / fluctuation)));
    for (std::size_t i = 0; i < m.size(); ++i) {
        const Vec3 as_rigid = rigid.velocity_at(x[i]);
        v[i] = as_rigid + scale * (v[i] - as_rigid);
    }
}

} // namespace weft
