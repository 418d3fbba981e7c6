#include "state/attachment.h"

#include "base/parallel.h"
#include "state/world.h"

#include <algorithm>

namespace weft {

namespace {

/// Rounding of the times of substeps, s.
constexpr double k_slack = 1e-9;

/// The points of a seam that has let go are two again to contact when this many weld tolerances
/// apart, which is the contact thickness: sooner, they would count as crossing.
constexpr double k_parted = 2.0;

bool is_joined(const Attachment& attachment, double gap, bool acts, bool before) {
    if (attachment.kind == AttachKind::Button) {
        return false; // its cloths lie on each other
    }
    return acts || (before && gap < k_parted * attachment.tolerance);
}

void update(const Attachment& attachment, double gap, double time, AttachedState& state) {
    const bool acts = acts_at(attachment, time);
    state.is_joined = is_joined(attachment, gap, acts, state.is_joined != 0) ? 1 : 0;
    if (!acts) {
        state.welded_since = -1.0;
        return;
    }
    if (state.start_gap < 0.0) {
        state.start_gap = gap;
    }
    const bool should_be_closed = time >= attachment.start + attachment.close - k_slack;
    if (attachment.weld && state.welded_since < 0.0 && should_be_closed &&
        gap <= attachment.rest_gap + attachment.tolerance) {
        state.welded_since = time;
    }
}

} // namespace

Vec3 pair_gap(const AttachedPair& pair, std::span<const Vec3> positions) {
    Vec3 gap = Vec3::Zero();
    for (std::size_t i = 0; i < 6; ++i) {
        if (pair.vertices[i] != k_no_index) {
            gap += pair.weights[i] * positions[static_cast<std::size_t>(pair.vertices[i])];
        }
    }
    return gap;
}

double allowed_gap(const Attachment& attachment, double start_gap, double t) {
    const double closed = attachment.close > 0.0
                              ? std::clamp((t - attachment.start) / attachment.close, 0.0, 1.0)
                              : 1.0;
    const double open = 1.0 - closed * closed * (3.0 - 2.0 * closed);
    return attachment.rest_gap + open * std::max(0.0, start_gap - attachment.rest_gap);
}

bool acts_at(const Attachment& attachment, double t) {
    return t >= attachment.start - k_slack && t <= attachment.until + k_slack;
}

void update_attachments(World& world, double time) {
    parallel_for(world.attached_pairs.size(), [&](std::size_t i) {
        const AttachedPair& pair = world.attached_pairs[i];
        const double gap = pair_gap(pair, world.positions).norm();
        update(world.attachments[static_cast<std::size_t>(pair.attachment)], gap, time,
               world.attached_states[i]);
    });
}

AttachmentReport measure_attachments(const World& world) {
    AttachmentReport report{.pairs = static_cast<int>(world.attached_pairs.size())};
    for (std::size_t i = 0; i < world.attached_pairs.size(); ++i) {
        const AttachedPair& pair = world.attached_pairs[i];
        const auto& attachment = world.attachments[static_cast<std::size_t>(pair.attachment)];
        report.welded += world.attached_states[i].welded_since >= 0.0 ? 1 : 0;
        if (acts_at(attachment, world.time)) {
            const double gap = pair_gap(pair, world.positions).norm() - attachment.rest_gap;
            report.greatest_gap = std::max(report.greatest_gap, gap);
        }
    }
    return report;
}

} // namespace weft
