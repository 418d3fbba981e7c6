#include "geometry/block_parts.h"

namespace weft {

namespace {

/// Fine cells whose coordinate along an axis is 0.
constexpr std::array<std::uint64_t, 3> k_low_face{0x1111111111111111U, 0x000F000F000F000FU,
                                                  0x000000000000FFFFU};
/// Bits from a fine cell to the next one along an axis.
constexpr std::array<int, 3> k_step{1, 4, 16};

/// A set and all fine cells beside it.
std::uint64_t grown(std::uint64_t set) {
    std::uint64_t all = set;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint64_t high_face = k_low_face[axis] << 3 * k_step[axis];
        all |= (set & ~high_face) << k_step[axis];
        all |= (set & ~k_low_face[axis]) >> k_step[axis];
    }
    return all;
}

} // namespace

std::vector<std::uint64_t> connected_sets(std::uint64_t set) {
    std::vector<std::uint64_t> parts;
    while (set != 0) {
        std::uint64_t part = set & (~set + 1);
        for (std::uint64_t next = grown(part) & set; next != part; next = grown(part) & set) {
            part = next;
        }
        parts.push_back(part);
        set &= ~part;
    }
    return parts;
}

bool meet_over_face(std::uint64_t low, std::uint64_t high, int axis) {
    const auto a = static_cast<std::size_t>(axis);
    return (low >> 3 * k_step[a] & high & k_low_face[a]) != 0;
}

double corner_share(const std::array<double, 64>& shares, std::uint64_t set, int corner) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 64; ++i) {
        if ((set >> i & 1) == 0) {
            continue;
        }
        double weight = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto step = static_cast<std::size_t>(k_step[static_cast<std::size_t>(axis)]);
            const double along = (static_cast<double>(i / step % 4) + 0.5) / 4.0;
            weight *= (corner >> axis & 1) != 0 ? along : 1.0 - along;
        }
        sum += shares[i] * weight;
    }
    return sum / 64.0;
}

} // namespace weft
