#include "forces/attachment_elements.h"

#include <cmath>
#include <limits>

namespace weft {

namespace {

/// A welded pair is this many times as stiff as one that closes, which is as stiff as the cloth:
/// under load its gap is the hundredth part of what an edge of the cloth beside it stretches.
/// Smaller: seams gape; larger: the linear solve takes more iterations.
constexpr double k_weld_stiffness = 100.0;

/// Damping along a taut thread, as a fraction of critical damping.
constexpr double k_damping_ratio = 1.0;

/// Tension of a thread at distance d, its energy, and its slope as the solve is to see it.
struct Tension {
    double energy, force, slope; ///< J, N, N/m
};

Tension tension(const Thread& thread, double distance) {
    const double stretch = distance - thread.rest_gap;
    if (stretch < 0.0 || thread.stiffness == 0.0) {
        return {0.0, 0.0, 0.0};
    }
    const double reach = thread.limit / thread.stiffness;
    if (stretch <= reach) {
        return {0.5 * thread.stiffness * stretch * stretch, thread.stiffness * stretch,
                thread.stiffness};
    }
    return {thread.limit * (stretch - 0.5 * reach), thread.limit, thread.limit / stretch};
}

/// Mass that one end of the pair moves against the other, kg.
double moved_mass(const AttachedPair& pair, std::span<const double> masses) {
    double inverse = 0.0;
    for (std::size_t i = 0; i < 6; ++i) {
        if (pair.vertices[i] != k_no_index) {
            inverse += pair.weights[i] * pair.weights[i] / masses[at(pair.vertices[i])];
        }
    }
    return 1.0 / inverse;
}

/// The thread of a pair in the substep from start_time to end_time (s).
Thread thread_of(const Attachment& attachment,
                 const AttachedPair& pair,
                 const AttachedState& state,
                 double mass,
                 double start_time,
                 double end_time) {
    if (state.start_gap < 0.0 || !acts_at(attachment, end_time)) {
        return {};
    }
    const bool is_welded = state.welded_since >= 0.0;
    const double stiffness = (is_welded ? k_weld_stiffness : 1.0) * attachment.stiffness;
    const double rest_gap = allowed_gap(attachment, state.start_gap, end_time);
    const double before = allowed_gap(attachment, state.start_gap, start_time);
    return {.rest_gap = rest_gap,
            .stiffness = stiffness,
            .limit = is_welded ? std::numeric_limits<double>::infinity() : pair.limit,
            .damping = 2.0 * k_damping_ratio * std::sqrt(stiffness * mass),
            .rest_rate = (rest_gap - before) / (end_time - start_time)};
}

} // namespace

ElementTerms<6> thread_terms(const std::array<Vec3, 6>& x,
                             const std::array<Vec3, 6>& v,
                             const std::array<double, 6>& weights,
                             const Thread& thread,
                             SystemScales scales) {
    Vec3 gap = Vec3::Zero();
    Vec3 rate = Vec3::Zero();
    for (std::size_t i = 0; i < 6; ++i) {
        gap += weights[i] * x[i];
        rate += weights[i] * v[i];
    }
    const double distance = gap.norm();
    const Vec3 along = distance > 0.0 ? Vec3(gap / distance) : Vec3(Vec3::Zero());
    const Tension t = tension(thread, distance);
    const double damping = t.force > 0.0 ? thread.damping : 0.0;
    const Vec3 pull = (t.force + damping * (along.dot(rate) - thread.rest_rate)) * along;
    // across itself a taut thread turns: T / d; a thread without length is as stiff in all ways
    const double turning = distance > 0.0 ? t.force / distance : t.slope;
    const Mat3 matrix = scales.stiffness * turning * Mat3::Identity() +
                        (scales.stiffness * (t.slope - turning) + scales.damping * damping) *
                            along * along.transpose();
    ElementTerms<6> terms;
    terms.energy = t.energy;
    for (std::size_t a = 0; a < 6; ++a) {
        terms.force[a] = -weights[a] * pull;
        for (std::size_t b = a; b < 6; ++b) {
            terms.stiffness[block_index(6, static_cast<int>(a), static_cast<int>(b))] =
                weights[a] * weights[b] * matrix;
        }
    }
    return terms;
}

AttachmentElements::AttachmentElements(const World& world)
    : pairs_(world.attached_pairs), threads_(world.attached_pairs.size()) {
    for (const AttachedPair& pair : pairs_) {
        masses_.push_back(moved_mass(pair, world.masses));
        nodes_.insert(nodes_.end(), pair.vertices.begin(), pair.vertices.end());
    }
}

void AttachmentElements::set(const World& world, double end_time) {
    assert(world.attached_states.size() == size() && end_time > world.time);
    parallel_for(size(), [&](std::size_t i) {
        threads_[i] = thread_of(world.attachments[at(pairs_[i].attachment)], pairs_[i],
                                world.attached_states[i], masses_[i], world.time, end_time);
    });
}

double AttachmentElements::energy_of(std::size_t pair, std::span<const Vec3> x) const {
    return tension(threads_[pair], pair_gap(pairs_[pair], x).norm()).energy;
}

ElementTerms<6> AttachmentElements::terms_of(std::size_t pair,
                                             std::span<const Vec3> x,
                                             std::span<const Vec3> v,
                                             SystemScales scales) const {
    std::array<Vec3, 6> positions, velocities;
    for (std::size_t a = 0; a < 6; ++a) {
        const Index vertex = pairs_[pair].vertices[a];
        const bool is_there = vertex != k_no_index;
        positions[a] = is_there ? x[at(vertex)] : Vec3(Vec3::Zero());
        velocities[a] = is_there ? v[at(vertex)] : Vec3(Vec3::Zero());
    }
    return thread_terms(positions, velocities, pairs_[pair].weights, threads_[pair], scales);
}

} // namespace weft
