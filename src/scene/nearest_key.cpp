#include "scene/nearest_key.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace weft {
namespace {

/// Halves, so that a wrong case costs 1 and any other replacement 2.
int replace_cost(char a, char b) {
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    return a == b ? 0 : lower(a) == lower(b) ? 1 : 2;
}

/// Optimal string alignment (Damerau 1964), in halves.
int edit_distance(std::string_view a, std::string_view b) {
    const std::size_t columns = b.size() + 1;
    std::vector<int> cost((a.size() + 1) * columns);
    const auto at = [&](std::size_t i, std::size_t j) -> int& { return cost[i * columns + j]; };
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                at(i, j) = static_cast<int>(2 * (i + j));
                continue;
            }
            int best = std::min(at(i - 1, j), at(i, j - 1)) + 2;
            best = std::min(best, at(i - 1, j - 1) + replace_cost(a[i - 1], b[j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                best = std::min(best, at(i - 2, j - 2) + 2);
            }
            at(i, j) = best;
        }
    }
    return cost.back();
}

} // namespace

std::string nearest_key(std::string_view word, std::span<const std::string> candidates) {
    const auto nearest = std::min_element(
        candidates.begin(), candidates.end(), [&](const std::string& a, const std::string& b) {
            return edit_distance(word, a) < edit_distance(word, b);
        });
    return nearest == candidates.end() ? "" : *nearest;
}

} // namespace weft
