#include "state/update_attachments.h"

#include "base/parallel.h"

namespace weft {

namespace {

/// The points of a seam that has let go are two again to contact when this many weld tolerances
/// apart, which is the contact thickness: sooner, they would count as crossing.
constexpr double k_parted = 2.0;

/// Times are sums of rounded shares, s.
constexpr double k_slack = 1e-9;

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
