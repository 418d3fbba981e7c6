#include "frames/measures.h"

#include "base/parallel.h"
#include "geometry/lattice.h"

#include <span>

namespace weft {

namespace {

std::span<const Vec3> particles_of(const World& world, const Body& body) {
    return std::span(world.positions).subspan(at(body.first_particle), at(body.particle_count));
}

/// Six times the volume of the tetrahedron of four corners of a cell.
double volume(const std::array<Vec3, 8>& x, const std::array<int, 4>& t) {
    const Vec3& origin = x[at(t[0])];
    return (x[at(t[1])] - origin).cross(x[at(t[2])] - origin).dot(x[at(t[3])] - origin);
}

bool is_inverted(const std::array<Vec3, 8>& x) {
    for (const auto& tetrahedron : k_cell_tetrahedra) {
        if (!(volume(x, tetrahedron) > 0.0)) {
            return true;
        }
    }
    for (int corner = 0; corner < 8; ++corner) {
        // Its neighbours along x, y, z; their order turns left where an even number of its
        // coordinates are high.
        const bool even = ((corner ^ (corner >> 1) ^ (corner >> 2)) & 1) == 0;
        const double v = volume(x, {corner, corner ^ 1, corner ^ 2, corner ^ 4});
        if (!(even ? v > 0.0 : v < 0.0)) {
            return true;
        }
    }
    return false;
}

} // namespace

std::vector<StrainMeasures> measure_triangles(const World& world, const Cloth& cloth) {
    const auto x = world.positions_of(cloth);
    const MembraneStiffness stiffness = membrane_stiffness(cloth.params.fabric);
    std::vector<StrainMeasures> measures(cloth.triangles.size());
    parallel_for(measures.size(), [&](std::size_t t) {
        const auto corner = [&](std::size_t k) {
            return x[static_cast<std::size_t>(cloth.triangles[t][k])];
        };
        measures[t] = strain_measures({corner(0), corner(1), corner(2)}, cloth.rest[t], stiffness);
    });
    return measures;
}

std::vector<EdgeStretch> edge_stretches(const EdgeNetwork& network, std::span<const Vec3> x) {
    std::vector<EdgeStretch> stretches;
    for (std::size_t e = 0; e < network.size(); ++e) {
        const NetworkEdge& edge = network[e];
        if (edge.kind != EdgeKind::Bending) {
            const Vec3& a = x[static_cast<std::size_t>(edge.vertices[0])];
            const Vec3& b = x[static_cast<std::size_t>(edge.vertices[1])];
            stretches.push_back({e, (a - b).norm() / edge.rest_length});
        }
    }
    return stretches;
}

VertexEdgeMeasures measure_edges(const EdgeNetwork& network,
                                 const LawShape& shape,
                                 std::span<const Vec3> x,
                                 std::size_t count) {
    std::vector<double> stretch(count, 0.0);
    std::vector<double> tension(count, 0.0);
    std::vector<int> edges(count, 0);
    for (const EdgeStretch& s : edge_stretches(network, x)) {
        const NetworkEdge& edge = network[s.edge];
        const double over_length = edge_response(shape, edge.stiffness, 1.0, s.stretch).tension;
        for (const Index v : edge.vertices) {
            const auto i = static_cast<std::size_t>(v);
            stretch[i] += s.stretch;
            tension[i] += over_length;
            ++edges[i];
        }
    }
    VertexEdgeMeasures means;
    for (std::size_t i = 0; i < count; ++i) {
        const double weight = edges[i] > 0 ? 1.0 / edges[i] : 0.0;
        means.stretch.push_back(edges[i] > 0 ? static_cast<float>(weight * stretch[i]) : 1.0F);
        means.tension.push_back(static_cast<float>(weight * tension[i]));
    }
    return means;
}

std::vector<double> edge_stretches(const World& world, const Solid& solid) {
    const auto x = particles_of(world, solid.body);
    std::vector<double> stretches(solid.network.size());
    parallel_for(stretches.size(), [&](std::size_t e) {
        const NetworkEdge& edge = solid.network[e];
        stretches[e] =
            (x[at(edge.vertices[0])] - x[at(edge.vertices[1])]).norm() / edge.rest_length;
    });
    return stretches;
}

std::vector<double> surface_stretches(const World& world, const Solid& solid) {
    const std::vector<double> stretches = edge_stretches(world, solid);
    std::vector<double> sums(at(solid.body.particle_count), 0.0);
    std::vector<int> counts(sums.size(), 0);
    for (std::size_t e = 0; e < stretches.size(); ++e) {
        for (const Index particle : solid.network[e].vertices) {
            sums[at(particle)] += stretches[e];
            ++counts[at(particle)];
        }
    }
    std::vector<double> carried;
    carried.reserve(solid.body.embeddings.size());
    for (const Embedding& embedding : solid.body.embeddings) {
        double value = 0.0;
        for (std::size_t k = 0; k < 4 && embedding.particles[k] != k_no_index; ++k) {
            const std::size_t p = at(embedding.particles[k]);
            value += embedding.weights[k] * (counts[p] > 0 ? sums[p] / counts[p] : 1.0);
        }
        carried.push_back(value);
    }
    return carried;
}

std::size_t count_inverted_cells(const World& world, const Solid& solid) {
    const auto x = particles_of(world, solid.body);
    return parallel_reduce(
        solid.cells.size(), std::size_t{0},
        [&](std::size_t c) {
            std::array<Vec3, 8> corners;
            for (std::size_t k = 0; k < 8; ++k) {
                corners[k] = x[at(solid.cells[c][k])];
            }
            return std::size_t{is_inverted(corners) ? 1U : 0U};
        },
        [](std::size_t a, std::size_t b) { return a + b; });
}

double body_volume(const World& world, const Body& body) {
    const auto x = std::span(world.positions).subspan(at(body.first_vertex), at(body.vertex_count));
    if (x.empty()) {
        return 0.0;
    }
    const Vec3 origin = x[0]; // near, for rounding's sake
    const auto volume_from_origin = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        return (a - origin).dot((b - origin).cross(c - origin)) / 6.0;
    };
    double sum = parallel_sum(body.triangles.size(), [&](std::size_t t) {
        const Triangle& v = body.triangles[t];
        return volume_from_origin(x[at(v[0])], x[at(v[1])], x[at(v[2])]);
    });
    for (const std::vector<Index>& loop : boundary_loops(body.topology)) {
        Vec3 middle = Vec3::Zero();
        for (const Index v : loop) {
            middle += x[at(v)] / static_cast<double>(loop.size());
        }
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const Vec3& a = x[at(loop[k])];
            const Vec3& b = x[at(loop[(k + 1) % loop.size()])];
            sum += volume_from_origin(b, a, middle);
        }
    }
    return sum;
}

} // namespace weft
