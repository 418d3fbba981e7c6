#pragma once

#include "base/eigen.h"
#include "scene/params.h"

#include <span>
#include <string>
#include <vector>

namespace weft {

struct World;

/// The parameters common to all pairs of one `[[attach]]`.
struct Attachment {
    std::string name;
    AttachKind kind = AttachKind::Seam;
    double start = 0.0, close = 1.0, until = k_forever; ///< s
    bool weld = true;
    double rest_gap = 0.0;        ///< m: contact thickness of the cloths for a button, else 0
    double tolerance = 1e-3;      ///< m: a pair this near to its rest gap is closed
    double stiffness = 1000.0;    ///< stiffness of a pair while it closes, N/m
    std::array<Index, 2> cloth{}; ///< indices into World::cloths
    std::array<double, 2> length{0.0, 0.0}; ///< rest lengths of the sides of a seam, m
    bool is_joint = false; ///< true: made of a pin `to` a rigid body, not of an `[[attach]]`
};

/// Two points of cloth that are drawn together. Their gap is the sum of weight * position: weights
/// of side a are > 0 and sum to 1, weights of side b are < 0 and sum to -1.
struct AttachedPair {
    std::array<Index, 6> vertices; ///< World vertices, each once; k_no_index in unused places
    std::array<double, 6> weights; ///< 0 in unused places
    Index attachment;              ///< index into World::attachments
    double limit;                  ///< N, greatest force while it closes
};

/// The part of a pair that changes in time. It has no padding, as it is stored and hashed as bytes.
struct AttachedState {
    double start_gap = -1.0;    ///< m, distance when it began to act; < 0: it has not yet
    double welded_since = -1.0; ///< s; < 0: it is not welded
    std::int64_t is_joined = 0; ///< 1: contact treats its vertices as one and lets them meet
};

/// Vector from side b to side a, m.
Vec3 pair_gap(const AttachedPair& pair, std::span<const Vec3> positions);

/// Greatest distance (m) that a pair may have at time t (s). It falls from the gap at the start to
/// the rest gap on a smooth curve whose slope is zero at both ends.
double allowed_gap(const Attachment& attachment, double start_gap, double t);

/// Whether the attachment acts during a substep that ends at time t (s).
bool acts_at(const Attachment& attachment, double t);

/// Updates the attached pairs for the world's positions at `time` (s): which begin to act, which
/// are closed and weld, which contact treats as one. Called when the world is built and after each
/// substep.
void update_attachments(World& world, double time);

/// Progress of the attached pairs, for the statistics.
struct AttachmentReport {
    int pairs = 0;
    int welded = 0;
    double greatest_gap = 0.0; ///< m beyond the rest gap, over the pairs that act
};

AttachmentReport measure_attachments(const World& world);

} // namespace weft
