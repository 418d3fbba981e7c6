#include "state/attachment.h"

#include <algorithm>

namespace weft {

namespace {

/// Times are sums of rounded shares, s.
constexpr double k_slack = 1e-9;

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
    const double share = attachment.close > 0.0
                             ? std::clamp((t - attachment.start) / attachment.close, 0.0, 1.0)
                             : 1.0;
    const double open = 1.0 - share * share * (3.0 - 2.0 * share);
    return attachment.rest_gap + open * std::max(0.0, start_gap - attachment.rest_gap);
}

bool acts_at(const Attachment& attachment, double t) {
    return t >= attachment.start - k_slack && t <= attachment.until + k_slack;
}

} // namespace weft
