#include "geometry/lattice.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>

namespace weft {

namespace {

/// Makes a box; particle (x, y, z) is number x + (n0 + 1) (y + (n1 + 1) z).
class BoxFiller {
public:
    BoxFiller(const std::array<int, 3>& cells, double spacing)
        : n_(cells), low_(-0.5 * spacing * Vec3(cells[0], cells[1], cells[2])) {
        fill_.spacing = spacing;
    }

    LatticeFill fill() {
        add_particles();
        add_cells();
        on_surface_.assign(fill_.particles.size(), k_no_index);
        for (int axis = 0; axis < 3; ++axis) {
            add_face(axis, 0);
            add_face(axis, n_[at(axis)]);
        }
        return std::move(fill_);
    }

private:
    Index particle(const std::array<int, 3>& p) const {
        return p[0] + (n_[0] + 1) * (p[1] + (n_[1] + 1) * p[2]);
    }

    void add_particles() {
        for (int z = 0; z <= n_[2]; ++z) {
            for (int y = 0; y <= n_[1]; ++y) {
                for (int x = 0; x <= n_[0]; ++x) {
                    fill_.particles.emplace_back(low_ + fill_.spacing * Vec3(x, y, z));
                }
            }
        }
        fill_.volumes.assign(fill_.particles.size(), 0.0);
    }

    void add_cells() {
        for (int z = 0; z < n_[2]; ++z) {
            for (int y = 0; y < n_[1]; ++y) {
                for (int x = 0; x < n_[0]; ++x) {
                    CellCorners& cell = fill_.cells.emplace_back();
                    for (int c = 0; c < 8; ++c) {
                        cell[at(c)] = particle({x + (c & 1), y + (c >> 1 & 1), z + (c >> 2)});
                        fill_.volumes[at(cell[at(c)])] += 0.125 * std::pow(fill_.spacing, 3);
                    }
                }
            }
        }
    }

    Index vertex(const std::array<int, 3>& p) {
        Index& v = on_surface_[at(particle(p))];
        if (v == k_no_index) {
            v = static_cast<Index>(fill_.surface.positions.size());
            fill_.surface.positions.push_back(fill_.particles[at(particle(p))]);
            fill_.places.push_back(
                {.particles = {particle(p), -1, -1, -1}, .weights = {1.0, 0.0, 0.0, 0.0}});
        }
        return v;
    }

    /// The face whose coordinate along an axis is `level`.
    void add_face(int axis, int level) {
        const std::size_t u = at((axis + 1) % 3);
        const std::size_t v = at((axis + 2) % 3); // u, v, axis are right-handed
        for (int j = 0; j < n_[v]; ++j) {
            for (int i = 0; i < n_[u]; ++i) {
                const auto corner = [&](int du, int dv) {
                    std::array<int, 3> p{};
                    p[at(axis)] = level;
                    p[u] = i + du;
                    p[v] = j + dv;
                    return vertex(p);
                };
                add_quad({corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)}, level > 0,
                         (i + j) % 2 == 0);
            }
        }
    }

    /// @param quad  counter-clockwise seen from the high side
    void add_quad(std::array<Index, 4> quad, bool faces_up, bool from_first) {
        if (!faces_up) {
            std::swap(quad[1], quad[3]);
        }
        const std::size_t s = from_first ? 0 : 1;
        fill_.surface.triangles.push_back({quad[s], quad[s + 1], quad[s + 2]});
        fill_.surface.triangles.push_back({quad[s], quad[s + 2], quad[(s + 3) % 4]});
    }

    std::array<int, 3> n_;
    Vec3 low_;
    std::vector<Index> on_surface_; ///< vertex of each particle
    LatticeFill fill_;
};

} // namespace

LatticeFill fill_box(const std::array<int, 3>& cells, double spacing) {
    return BoxFiller(cells, spacing).fill();
}

std::vector<LatticeEdge> lattice_edges(const LatticeFill& fill) {
    std::vector<LatticeEdge> edges;
    edges.reserve(28 * fill.cells.size());
    for (const CellCorners& cell : fill.cells) {
        for (unsigned a = 0; a < 8; ++a) {
            for (unsigned b = a + 1; b < 8; ++b) {
                const int axes = std::popcount(a ^ b);
                edges.push_back({{std::min(cell[a], cell[b]), std::max(cell[a], cell[b])},
                                 static_cast<LatticeEdgeKind>(axes - 1)});
            }
        }
    }
    const auto before = [](const LatticeEdge& a, const LatticeEdge& b) {
        return a.particles < b.particles;
    };
    const auto same = [](const LatticeEdge& a, const LatticeEdge& b) {
        return a.particles == b.particles;
    };
    std::sort(edges.begin(), edges.end(), before);
    edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
    edges.shrink_to_fit();
    return edges;
}

std::vector<double> lattice_masses(const LatticeFill& fill, double mass) {
    const auto count = static_cast<double>(fill.particles.size());
    const double volume = std::accumulate(fill.volumes.begin(), fill.volumes.end(), 0.0);
    assert(volume > 0.0);
    const double inside = mass / volume * fill.spacing * fill.spacing * fill.spacing;
    const double least = std::min(inside / 64.0, 0.125 * mass / count);
    // Each round takes from the heavier ones what those below the least are given, until no more
    // fall below it; the least is so low that most of the mass is always left.
    std::vector<double> masses(fill.volumes.size());
    double density = mass / volume;
    for (std::size_t round = 0; round < 64; ++round) {
        double light = 0.0;
        double heavy = 0.0;
        for (std::size_t i = 0; i < masses.size(); ++i) {
            masses[i] = std::max(least, density * fill.volumes[i]);
            (masses[i] > least ? heavy : light) += masses[i];
        }
        const double factor = (mass - light) / heavy;
        if (factor >= 1.0 - 1e-15) {
            break;
        }
        density *= factor;
    }
    const double sum = std::accumulate(masses.begin(), masses.end(), 0.0);
    for (double& m : masses) {
        m *= mass / sum; // rounding, and what 64 rounds left
    }
    return masses;
}

} // namespace weft
