#include "state/calibrate_network.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>

namespace weft {

namespace {

/// Plane stress in Mandel's order 11, 22, sqrt(2) 12: products are those of the tensors.
using Stiffness = Mat3;

/// Steps towards the nearest stiffness; four edges of a cell at most depend on one another, and a
/// hundred bring them to four digits.
constexpr int k_fit_steps = 300;

/// What stretch along the yarns gives in shear, and the reverse, counts this much. Such couplings
/// of one triangle are the opposite of its neighbour's and cancel; counted in full they would be
/// avoided at the cost of the shear stiffness: 57 % of it on triangles with a right angle.
constexpr double k_coupling_weight = 0.1;

/// Least K of an edge as a fraction of its cell's mean, so that no part of a network comes loose.
constexpr double k_least_fraction = 1e-3;

Stiffness fabric_stiffness(const FabricParams& fabric) {
    const MembraneStiffness c = membrane_stiffness(fabric);
    Stiffness C;
    C << c.c11, c.c12, 0.0, c.c12, c.c22, 0.0, 0.0, 0.0, 2.0 * c.c33;
    return C;
}

NetworkModuli moduli_of(const Stiffness& C) {
    const Mat3 compliance = C.inverse();
    return {{1.0 / compliance(0, 0), 1.0 / compliance(1, 1)}, 0.5 / compliance(2, 2)};
}

/// Length times stretch energy of an edge: what 1 N/m of K along `edge` (m) adds to area times C.
Stiffness edge_stiffness(const Vec2& edge) {
    const double length_squared = edge.squaredNorm();
    const Vec3 m(edge.x() * edge.x(), edge.y() * edge.y(),
                 std::sqrt(2.0) * edge.x() * edge.y()); // L^2 m
    return m * m.transpose() / length_squared;
}

/// A part of the cloth that is strained as one, and its edges.
struct Cell {
    double area = 0.0;
    std::vector<std::size_t> edges; ///< indices into the network
    std::vector<Vec2> along;        ///< each of them at rest, weft and warp, m
};

/// Edges of a network by their ends.
class EdgeLookup {
public:
    explicit EdgeLookup(const EdgeNetwork& network) {
        for (std::size_t e = 0; e < network.size(); ++e) {
            const auto [a, b] = network[e].vertices;
            if (network[e].kind != EdgeKind::Bending) {
                edges_[{std::min(a, b), std::max(a, b)}] = e;
            }
        }
    }
    void add(Cell& cell, Index a, Index b, const Vec2& along) const {
        const auto found = edges_.find({std::min(a, b), std::max(a, b)});
        if (found != edges_.end() &&
            std::find(cell.edges.begin(), cell.edges.end(), found->second) == cell.edges.end()) {
            cell.edges.push_back(found->second);
            cell.along.push_back(along);
        }
    }

private:
    std::map<std::array<Index, 2>, std::size_t> edges_;
};

/// Triangles by polygon; quads are one cell.
std::vector<std::vector<Index>> cells_of(std::span<const Index> polygons) {
    std::map<Index, std::vector<Index>> members;
    for (std::size_t t = 0; t < polygons.size(); ++t) {
        members[polygons[t]].push_back(static_cast<Index>(t));
    }
    std::vector<std::vector<Index>> cells;
    for (const auto& [polygon, triangles] : members) {
        if (triangles.size() == 2) {
            cells.push_back(triangles);
        } else {
            for (const Index t : triangles) {
                cells.push_back({t});
            }
        }
    }
    return cells;
}

/// Corner of a triangle by its vertex.
Vec2 corner(const Cloth& cloth, Index t, Index vertex) {
    const Triangle& triangle = cloth.triangles[at(t)];
    const auto k = std::find(triangle.begin(), triangle.end(), vertex) - triangle.begin();
    return rest_corners(cloth.rest[at(t)])[static_cast<std::size_t>(k)];
}

Index apex_of(const Triangle& triangle, const Triangle& other) {
    for (const Index v : triangle) {
        if (std::find(other.begin(), other.end(), v) == other.end()) {
            return v;
        }
    }
    return k_no_index;
}

Cell make_cell(const Cloth& cloth, const std::vector<Index>& triangles, const EdgeLookup& lookup) {
    Cell cell;
    for (const Index t : triangles) {
        const Triangle& v = cloth.triangles[at(t)];
        const auto x = rest_corners(cloth.rest[at(t)]);
        cell.area += cloth.rest[at(t)].area;
        for (std::size_t k = 0; k < 3; ++k) {
            lookup.add(cell, v[k], v[(k + 1) % 3], x[(k + 1) % 3] - x[k]);
        }
    }
    if (triangles.size() == 2) {
        const Triangle& a = cloth.triangles[at(triangles[0])];
        const Triangle& b = cloth.triangles[at(triangles[1])];
        const Index apex_a = apex_of(a, b);
        const Index apex_b = apex_of(b, a);
        if (apex_a != k_no_index && apex_b != k_no_index) {
            const Index shared = a[0] == apex_a ? a[1] : a[0];
            const Vec2 along =
                corner(cloth, triangles[0], shared) - corner(cloth, triangles[0], apex_a) +
                corner(cloth, triangles[1], apex_b) - corner(cloth, triangles[1], shared);
            lookup.add(cell, apex_a, apex_b, along);
        }
    }
    return cell;
}

Stiffness weighted(Stiffness C) {
    C.block<2, 1>(0, 2) *= k_coupling_weight;
    C.block<1, 2>(2, 0) *= k_coupling_weight;
    return C;
}

/// K of the cell's edges, none negative, with which area times C is nearest to `target`: projected
/// gradient steps from equal ones, so that edges alike get alike.
std::vector<double> fit(const Cell& cell, const Stiffness& target) {
    std::vector<Stiffness> parts;
    double greatest = 0.0; // bound of the curvature: its trace
    double along = 0.0;
    for (const Vec2& edge : cell.along) {
        parts.push_back(weighted(edge_stiffness(edge)));
        greatest += parts.back().squaredNorm();
        along += parts.back().trace();
    }
    const double mean = target.trace() / along;
    std::vector<double> K(parts.size(), mean);
    for (int step = 0; step < k_fit_steps; ++step) {
        Stiffness miss = -weighted(target);
        for (std::size_t e = 0; e < K.size(); ++e) {
            miss += K[e] * parts[e];
        }
        for (std::size_t e = 0; e < K.size(); ++e) {
            K[e] -= miss.cwiseProduct(parts[e]).sum() / greatest;
            K[e] = std::max(K[e], k_least_fraction * mean);
        }
    }
    return K;
}

} // namespace

void calibrate_network(const Cloth& cloth, std::span<const Index> polygons, EdgeNetwork& network) {
    const Stiffness C = fabric_stiffness(cloth.params.fabric);
    const EdgeLookup lookup(network);
    std::vector<double> sums(network.size(), 0.0);
    for (const std::vector<Index>& triangles : cells_of(polygons)) {
        const Cell cell = make_cell(cloth, triangles, lookup);
        const std::vector<double> K = fit(cell, cell.area * C);
        for (std::size_t e = 0; e < K.size(); ++e) {
            sums[cell.edges[e]] += K[e];
        }
    }
    for (std::size_t e = 0; e < network.size(); ++e) {
        if (network[e].kind != EdgeKind::Bending) {
            network[e].stiffness = sums[e];
        }
    }
}

NetworkModuli network_moduli(const Cloth& cloth) {
    const EdgeLookup lookup(cloth.network);
    std::vector<char> is_counted(cloth.network.size(), 0);
    Stiffness sum = Stiffness::Zero();
    double area = 0.0;
    const auto count = [&](const Cell& cell) {
        for (std::size_t i = 0; i < cell.edges.size(); ++i) {
            const std::size_t e = cell.edges[i];
            if (is_counted[e] == 0) {
                is_counted[e] = 1;
                sum += cloth.network[e].stiffness * edge_stiffness(cell.along[i]);
            }
        }
    };
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        count(make_cell(cloth, {static_cast<Index>(t)}, lookup));
        area += cloth.rest[t].area;
    }
    for (const MeshEdge& edge : cloth.topology.edges) { // diagonals that are no edge of the mesh
        if (!edge.is_boundary()) {
            count(make_cell(cloth, {edge.triangle[0], edge.triangle[1]}, lookup));
        }
    }
    return moduli_of(sum / area);
}

std::string calibration_error_text(const Cloth& cloth) {
    const NetworkModuli network = network_moduli(cloth);
    const NetworkModuli fabric = moduli_of(fabric_stiffness(cloth.params.fabric));
    const auto percent = [](double a, double b) { return 100.0 * (a / b - 1.0); };
    return fmt::format("stretch {:+.1f} % (weft), {:+.1f} % (warp), shear {:+.1f} %",
                       percent(network.stretch[0], fabric.stretch[0]),
                       percent(network.stretch[1], fabric.stretch[1]),
                       percent(network.shear, fabric.shear));
}

} // namespace weft
