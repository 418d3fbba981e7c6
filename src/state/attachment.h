#pragma once

#include "base/eigen.h"
#include "scene/params.h"

#include <span>
#include <string>
#include <vector>

namespace weft {

/// What the pairs of one `[[attach]]` share.
struct Attachment {
    std::string name;
    AttachKind kind = AttachKind::Seam;
    double start = 0.0, close = 1.0, until = k_forever; ///< s
    bool weld = true;
    double rest_gap = 0.0;        ///< m: of a button the contact thickness of its cloths, else 0
    double tolerance = 1e-3;      ///< m: a pair this near to its rest gap is closed
    double stiffness = 1000.0;    ///< of a pair while it closes, N/m
    std::array<Index, 2> cloth{}; ///< of World::cloths
    std::array<double, 2> length{0.0, 0.0}; ///< of the sides of a seam at rest, m
    bool is_joint = false; ///< a pin that a rigid body leads, not asked for by `[[attach]]`
};

/// Two points of cloth that belong together. Their gap is the sum of weight * position: those of
/// side a have weights > 0 that sum to 1, those of side b weights < 0 that sum to -1.
struct AttachedPair {
    std::array<Index, 6> vertices; ///< of World, each once; k_no_index where there is none
    std::array<double, 6> weights; ///< 0 there
    Index attachment;              ///< of World::attachments
    double limit;                  ///< N, most force while it closes
};

/// What changes of a pair. No padding: it is kept and hashed as bytes.
struct AttachedState {
    double start_gap = -1.0;    ///< m, distance when it began to act; < 0: not yet
    double welded_since = -1.0; ///< s; < 0: not welded
    std::int64_t is_joined = 0; ///< 1: contact takes its vertices as one, not to hold them apart
};

/// Vector from side b to side a, m.
Vec3 pair_gap(const AttachedPair& pair, std::span<const Vec3> positions);

/// Distance (m) that a pair is let have at time t (s): from its gap at the start smoothly to the
/// rest gap, at rest at both ends; never more than it started with.
double allowed_gap(const Attachment& attachment, double start_gap, double t);

/// Has the time come at which it acts, and not yet at which it lets go? Of a substep that ends at
/// t.
bool acts_at(const Attachment& attachment, double t);

} // namespace weft
