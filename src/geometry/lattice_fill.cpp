#include "geometry/lattice_fill.h"

#include "base/disjoint_sets.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace weft {

namespace {

// Sets of the 64 fine cells of a lattice's cell as bits: fine cell (x, y, z) is bit x + 4 (y + 4
// z).

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

/// The parts of a set that are connected through faces of fine cells, by their lowest bits.
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

/// Do a set of one cell and a set of the next one along an axis (0, 1, 2) meet in the common face?
bool meet_over_face(std::uint64_t low, std::uint64_t high, int axis) {
    return (low >> 3 * k_step[at(axis)] & high & k_low_face[at(axis)]) != 0;
}

/// Sum over a set of the fractions of its fine cells that are inside, each times the trilinear
/// weight of a corner (x + 2 y + 4 z) at the middle of the fine cell, in volumes of the cell.
double corner_volume(const std::array<double, 64>& fractions, std::uint64_t set, int corner) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 64; ++i) {
        if ((set >> i & 1) == 0) {
            continue;
        }
        double weight = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto step = at(k_step[at(axis)]);
            const double along = (static_cast<double>(i / step % 4) + 0.5) / 4.0;
            weight *= (corner >> axis & 1) != 0 ? along : 1.0 - along;
        }
        sum += fractions[i] * weight;
    }
    return sum / 64.0;
}

/// One part of the inside in one cell.
struct CellPart {
    Index cell;         ///< number in the lattice
    std::uint64_t fine; ///< its fine cells
    Index block;        ///< number in the raster; k_full: all of the cell
};

class Filler {
public:
    Filler(const LatticeRaster& raster, const TriangleMesh& surface)
        : raster_(raster), lattice_(raster.lattice), surface_(surface) {}

    LatticeFill fill() {
        fill_.spacing = lattice_.spacing;
        fill_.surface = surface_;
        find_parts();
        make_particles();
        give_volumes();
        if (!parts_.empty()) {
            place_surface();
        }
        return std::move(fill_);
    }

private:
    void find_parts() {
        first_part_.reserve(raster_.cells.size() + 1);
        for (std::size_t cell = 0; cell < raster_.cells.size(); ++cell) {
            first_part_.push_back(static_cast<Index>(parts_.size()));
            const Index block = raster_.cells[cell];
            if (block == LatticeRaster::k_full) {
                parts_.push_back({static_cast<Index>(cell), ~std::uint64_t{0}, block});
            } else if (block >= 0) {
                for (const std::uint64_t part : connected_sets(raster_.blocks[at(block)].touched)) {
                    parts_.push_back({static_cast<Index>(cell), part, block});
                }
            }
        }
        first_part_.push_back(static_cast<Index>(parts_.size()));
    }

    std::array<int, 3> place_of(Index cell) const {
        const auto& n = lattice_.size;
        return {cell % n[0], cell / n[0] % n[1], cell / n[0] / n[1]};
    }

    std::span<const CellPart> parts_of(Index cell) const {
        return std::span(parts_).subspan(at(first_part_[at(cell)]),
                                         at(first_part_[at(cell) + 1] - first_part_[at(cell)]));
    }

    /// Joins the corners on the common face of parts of neighbouring cells that meet there.
    void join_over_face(DisjointSets& sets, Index part, int axis) const {
        const auto place = place_of(parts_[at(part)].cell);
        if (place[at(axis)] + 1 == lattice_.size[at(axis)]) {
            return;
        }
        const Index step = axis == 0   ? 1
                           : axis == 1 ? lattice_.size[0]
                                       : lattice_.size[0] * lattice_.size[1];
        const Index next = parts_[at(part)].cell + step;
        for (Index other = first_part_[at(next)]; other < first_part_[at(next) + 1]; ++other) {
            if (!meet_over_face(parts_[at(part)].fine, parts_[at(other)].fine, axis)) {
                continue;
            }
            const int bit = 1 << axis;
            for (int corner = 0; corner < 8; ++corner) {
                if ((corner & bit) != 0) {
                    sets.join(8 * part + corner, 8 * other + corner - bit);
                }
            }
        }
    }

    void make_particles() {
        DisjointSets sets(8 * parts_.size());
        for (Index part = 0; part < static_cast<Index>(parts_.size()); ++part) {
            for (int axis = 0; axis < 3; ++axis) {
                join_over_face(sets, part, axis);
            }
        }
        std::vector<Index> particle_of(8 * parts_.size(), k_no_index);
        for (Index part = 0; part < static_cast<Index>(parts_.size()); ++part) {
            const auto place = place_of(parts_[at(part)].cell);
            CellCorners& cell = fill_.cells.emplace_back();
            for (int corner = 0; corner < 8; ++corner) {
                Index& particle = particle_of[at(sets.find(8 * part + corner))];
                if (particle == k_no_index) {
                    particle = static_cast<Index>(fill_.particles.size());
                    fill_.particles.push_back(lattice_.corner(place[0] + (corner & 1),
                                                              place[1] + (corner >> 1 & 1),
                                                              place[2] + (corner >> 2)));
                }
                cell[at(corner)] = particle;
            }
        }
    }

    void give_volumes() {
        const double cell_volume = std::pow(lattice_.spacing, 3);
        fill_.volumes.assign(fill_.particles.size(), 0.0);
        for (std::size_t p = 0; p < parts_.size(); ++p) {
            const CellPart& part = parts_[p];
            for (std::size_t corner = 0; corner < 8; ++corner) {
                double fraction = 0.125;
                if (part.block >= 0) {
                    fraction = corner_volume(raster_.blocks[at(part.block)].fractions, part.fine,
                                             static_cast<int>(corner));
                }
                fill_.volumes[at(fill_.cells[p][corner])] += fraction * cell_volume;
            }
        }
    }

    /// Mean normals at the vertices, not of unit length.
    std::vector<Vec3> vertex_normals() const {
        std::vector<Vec3> normals(surface_.positions.size(), Vec3::Zero());
        for (const Triangle& t : surface_.triangles) {
            const Vec3& a = surface_.positions[at(t[0])];
            const Vec3 normal =
                (surface_.positions[at(t[1])] - a).cross(surface_.positions[at(t[2])] - a);
            for (const Index v : t) {
                normals[at(v)] += normal;
            }
        }
        return normals;
    }

    void place_surface() {
        const std::vector<Vec3> normals = vertex_normals();
        fill_.places.reserve(surface_.positions.size());
        for (std::size_t v = 0; v < surface_.positions.size(); ++v) {
            const Vec3 local = (surface_.positions[v] - lattice_.origin) / lattice_.spacing;
            fill_.places.push_back(place_in(part_at(local, normals[v]), local));
        }
    }

    /// The part in whose fine cells a vertex lies; of several the one furthest on its inner side.
    Index part_at(const Vec3& local, const Vec3& normal) const {
        for (const double reach : {1e-9, 1e-3, 1.0}) {
            Index best = k_no_index;
            double best_depth = -std::numeric_limits<double>::infinity();
            const Vec3 fine = local * k_fine;
            for_each_fine_cell(fine, reach, [&](const std::array<int, 3>& f) {
                const Index part = part_of_fine(f);
                const double depth =
                    normal.dot(fine - Vec3(f[0], f[1], f[2]) - Vec3::Constant(0.5));
                if (part != k_no_index && depth > best_depth) {
                    best = part;
                    best_depth = depth;
                }
            });
            if (best != k_no_index) {
                return best;
            }
        }
        return nearest_part(local);
    }

    template <typename F>
    void for_each_fine_cell(const Vec3& fine, double reach, const F& f) const {
        std::array<int, 3> low{};
        std::array<int, 3> high{};
        for (std::size_t k = 0; k < 3; ++k) {
            const double x = fine[static_cast<Eigen::Index>(k)];
            const int most = k_fine * lattice_.size[k] - 1;
            low[k] = std::clamp(static_cast<int>(std::floor(x - reach)), 0, most);
            high[k] = std::clamp(static_cast<int>(std::floor(x + reach)), 0, most);
        }
        for (int z = low[2]; z <= high[2]; ++z) {
            for (int y = low[1]; y <= high[1]; ++y) {
                for (int x = low[0]; x <= high[0]; ++x) {
                    f(std::array<int, 3>{x, y, z});
                }
            }
        }
    }

    Index part_of_fine(const std::array<int, 3>& f) const {
        const auto& n = lattice_.size;
        const Index cell = f[0] / k_fine + n[0] * (f[1] / k_fine + n[1] * (f[2] / k_fine));
        const int bit = f[0] % k_fine + k_fine * (f[1] % k_fine + k_fine * (f[2] % k_fine));
        const auto parts = parts_of(cell);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if ((parts[i].fine >> bit & 1) != 0) {
                return first_part_[at(cell)] + static_cast<Index>(i);
            }
        }
        return k_no_index;
    }

    /// The part whose cell is nearest. The winding number leaves the rim of an open surface outside
    /// all parts.
    Index nearest_part(const Vec3& local) const {
        assert(!parts_.empty());
        Index best = 0;
        double best_distance = std::numeric_limits<double>::infinity();
        for (std::size_t p = 0; p < parts_.size(); ++p) {
            const auto place = place_of(parts_[p].cell);
            const Vec3 middle = Vec3(place[0], place[1], place[2]) + Vec3::Constant(0.5);
            const double distance = (local - middle).cwiseAbs().maxCoeff();
            if (distance < best_distance) {
                best = static_cast<Index>(p);
                best_distance = distance;
            }
        }
        return best;
    }

    /// Barycentric weights in the tetrahedron of Kuhn whose coordinates are ordered like p's.
    LatticePlace place_in(Index part, const Vec3& local) const {
        const auto cell = place_of(parts_[at(part)].cell);
        const Vec3 p = local - Vec3(cell[0], cell[1], cell[2]);
        std::array<int, 3> axes{0, 1, 2};
        std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return p[a] > p[b]; });
        const std::array<double, 4> weights{1.0 - p[axes[0]], p[axes[0]] - p[axes[1]],
                                            p[axes[1]] - p[axes[2]], p[axes[2]]};
        LatticePlace place;
        std::size_t used = 0;
        int corner = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            corner += k > 0 ? 1 << axes[k - 1] : 0;
            if (weights[k] != 0.0) {
                place.particles[used] = fill_.cells[at(part)][at(corner)];
                place.weights[used++] = weights[k];
            }
        }
        return place;
    }

    const LatticeRaster& raster_;
    const Lattice& lattice_;
    const TriangleMesh& surface_;
    std::vector<CellPart> parts_;   ///< sorted by cell
    std::vector<Index> first_part_; ///< #cells + 1
    LatticeFill fill_;
};

} // namespace

LatticeFill fill_lattice(const LatticeRaster& raster, const TriangleMesh& surface) {
    return Filler(raster, surface).fill();
}

} // namespace weft
