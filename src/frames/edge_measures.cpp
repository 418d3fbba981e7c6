#include "frames/edge_measures.h"

namespace weft {

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
        const double share = edges[i] > 0 ? 1.0 / edges[i] : 0.0;
        means.stretch.push_back(edges[i] > 0 ? static_cast<float>(share * stretch[i]) : 1.0F);
        means.tension.push_back(static_cast<float>(share * tension[i]));
    }
    return means;
}

} // namespace weft
