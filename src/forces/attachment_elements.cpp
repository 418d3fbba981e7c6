#include "forces/attachment_elements.h"

#include "base/parallel.h"

#include <cassert>
#include <cmath>

namespace weft {

namespace {

/// A welded pair is this many times as stiff as one that closes, which is as stiff as the cloth:
/// under load its gap is the hundredth part of what an edge of the cloth beside it stretches.
/// Smaller: seams gape; larger: the linear solve takes more iterations.
constexpr double k_weld_stiffness = 100.0;

/// Of critical damping.
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

double moved_mass(const AttachedPair& pair, std::span<const double> masses) {
    double inverse = 0.0;
    for (std::size_t i = 0; i < 6; ++i) {
        if (pair.vertices[i] != k_no_index) {
            inverse += pair.weights[i] * pair.weights[i] /
                       masses[static_cast<std::size_t>(pair.vertices[i])];
        }
    }
    return 1.0 / inverse;
}

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
        const auto attachment = static_cast<std::size_t>(pairs_[i].attachment);
        threads_[i] = thread_of(world.attachments[attachment], pairs_[i], world.attached_states[i],
                                masses_[i], world.time, end_time);
    });
}

double AttachmentElements::energy(std::span<const Vec3> x) const {
    return parallel_sum(size(), [&](std::size_t i) {
        return tension(threads_[i], pair_gap(pairs_[i], x).norm()).energy;
    });
}

ElementTerms<6> AttachmentElements::terms(std::size_t pair,
                                          std::span<const Vec3> x,
                                          std::span<const Vec3> v,
                                          SystemScales scales) const {
    std::array<Vec3, 6> positions, velocities;
    for (std::size_t a = 0; a < 6; ++a) {
        const Index vertex = pairs_[pair].vertices[a];
        const bool is_there = vertex != k_no_index;
        positions[a] = is_there ? x[static_cast<std::size_t>(vertex)] : Vec3(Vec3::Zero());
        velocities[a] = is_there ? v[static_cast<std::size_t>(vertex)] : Vec3(Vec3::Zero());
    }
    return thread_terms(positions, velocities, pairs_[pair].weights, threads_[pair], scales);
}

void AttachmentElements::forces(std::span<const Vec3> x,
                                std::span<const Vec3> v,
                                std::span<Vec3> element_forces) const {
    assert(element_forces.size() == 6 * size());
    parallel_for(size(), [&](std::size_t e) {
        const auto force = terms(e, x, v, {}).force;
        std::copy(force.begin(), force.end(), element_forces.begin() + static_cast<long>(6 * e));
    });
}

void AttachmentElements::evaluate(std::span<const Vec3> x,
                                  std::span<const Vec3> v,
                                  SystemScales scales,
                                  std::span<Vec3> element_forces,
                                  std::span<Mat3> element_blocks) const {
    assert(element_forces.size() == 6 * size() && element_blocks.size() == 21 * size());
    parallel_for(size(), [&](std::size_t e) {
        const ElementTerms<6> result = terms(e, x, v, scales);
        std::copy(result.force.begin(), result.force.end(),
                  element_forces.begin() + static_cast<long>(6 * e));
        std::copy(result.stiffness.begin(), result.stiffness.end(),
                  element_blocks.begin() + static_cast<long>(21 * e));
    });
}

} // namespace weft
