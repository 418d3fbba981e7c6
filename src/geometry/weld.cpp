#include "geometry/weld.h"

#include <cassert>
#include <cmath>
#include <unordered_map>

namespace weft {

namespace {

/// Kept vertices by the cell of a grid that they lie in; a cell is a chain of vertex numbers.
class VertexGrid {
public:
    VertexGrid(const Vec3& origin, double cell, std::size_t vertices)
        : origin_(origin), cell_(cell) {
        first_.reserve(vertices);
    }

    void insert(const Vec3& p, Index vertex) {
        const auto [place, is_new] = first_.try_emplace(key(cell_of(p)), vertex);
        next_.resize(at(vertex) + 1, k_no_index);
        if (!is_new) {
            next_[at(vertex)] = place->second;
            place->second = vertex;
        }
    }

    Index nearest(const Vec3& p, double radius, const std::vector<Vec3>& positions) const {
        const Cell low = cell_of(p - Vec3::Constant(radius));
        const Cell high = cell_of(p + Vec3::Constant(radius));
        Index best = k_no_index;
        double best_distance = radius * radius;
        for (std::int64_t x = low[0]; x <= high[0]; ++x) {
            for (std::int64_t y = low[1]; y <= high[1]; ++y) {
                for (std::int64_t z = low[2]; z <= high[2]; ++z) {
                    const auto found = first_.find(key({x, y, z}));
                    Index kept = found == first_.end() ? k_no_index : found->second;
                    for (; kept != k_no_index; kept = next_[at(kept)]) {
                        const double d = (positions[at(kept)] - p).squaredNorm();
                        if (d < best_distance ||
                            (d == best_distance && (best == k_no_index || kept < best))) {
                            best = kept;
                            best_distance = d;
                        }
                    }
                }
            }
        }
        return best;
    }

private:
    using Cell = std::array<std::int64_t, 3>;

    Cell cell_of(const Vec3& p) const {
        const Vec3 q = (p - origin_) / cell_;
        return {static_cast<std::int64_t>(std::floor(q.x())),
                static_cast<std::int64_t>(std::floor(q.y())),
                static_cast<std::int64_t>(std::floor(q.z()))};
    }

    /// 21 bits an axis; cells that share a key only cost time, since distances are compared.
    static std::uint64_t key(const Cell& cell) {
        constexpr std::uint64_t mask = (1U << 21U) - 1U;
        return ((static_cast<std::uint64_t>(cell[0]) & mask) << 42U) |
               ((static_cast<std::uint64_t>(cell[1]) & mask) << 21U) |
               (static_cast<std::uint64_t>(cell[2]) & mask);
    }

    Vec3 origin_;
    double cell_;
    std::unordered_map<std::uint64_t, Index> first_; // looked up, never walked
    std::vector<Index> next_;
};

} // namespace

double bounding_diagonal(std::span<const Vec3> positions) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : positions) {
        if (p.allFinite()) {
            box.extend(p);
        }
    }
    return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

Weld weld_vertices(std::span<const Vec3> positions, double tolerance) {
    assert(tolerance >= 0.0);
    Weld weld;
    weld.new_index.reserve(positions.size());
    const double diagonal = bounding_diagonal(positions);
    // Cells of a few tolerances: nearly every vertex looks into one cell. Not below what 21 bits an
    // axis can tell apart.
    const double cell = std::max({4.0 * tolerance, 1e-6 * diagonal, 1e-300});
    VertexGrid grid(positions.empty() ? Vec3::Zero() : positions[0], cell, positions.size());
    for (const Vec3& p : positions) {
        assert(p.allFinite());
        Index kept = grid.nearest(p, tolerance, weld.positions);
        if (kept == k_no_index) {
            kept = static_cast<Index>(weld.positions.size());
            weld.positions.push_back(p);
            grid.insert(p, kept);
        }
        weld.new_index.push_back(kept);
    }
    return weld;
}

} // namespace weft
