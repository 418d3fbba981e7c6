#include "geometry/lattice_fill.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <numeric>

namespace weft {

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
