#include "geometry/split_edges.h"

namespace weft {

namespace {

/// Vertices in the middle of edges, by edge; k_no_index: it stays whole.
std::vector<Index> halve(TriangleMesh& mesh, const EdgeTopology& topology, double longest) {
    std::vector<Index> middles(topology.edges.size(), k_no_index);
    for (std::size_t e = 0; e < middles.size(); ++e) {
        const Vec3& a = mesh.positions[at(topology.edges[e].v[0])];
        const Vec3& b = mesh.positions[at(topology.edges[e].v[1])];
        if ((a - b).norm() > longest) {
            middles[e] = static_cast<Index>(mesh.positions.size());
            mesh.positions.emplace_back(0.5 * (a + b));
        }
    }
    return middles;
}

/// The triangles that a triangle becomes.
class Pieces {
public:
    Pieces(const TriangleMesh& mesh, std::vector<Triangle>& out) : mesh_(mesh), out_(out) {}

    /// @param middle  on the edge opposite to each corner, or k_no_index
    void add(const Triangle& t, const std::array<Index, 3>& middle) {
        const int halved = (middle[0] >= 0) + (middle[1] >= 0) + (middle[2] >= 0);
        if (halved == 0) {
            out_.push_back(t);
        } else if (halved == 3) {
            out_.push_back(middle);
            for (std::size_t k = 0; k < 3; ++k) {
                out_.push_back({t[k], middle[(k + 2) % 3], middle[(k + 1) % 3]});
            }
        } else {
            std::size_t k = 0; // halved == 1: the edge opposite to k is halved; 2: is whole
            while ((middle[k] >= 0) != (halved == 1)) {
                ++k;
            }
            halved == 1 ? in_two(t, middle, k) : in_three(t, middle, k);
        }
    }

private:
    void in_two(const Triangle& t, const std::array<Index, 3>& middle, std::size_t k) {
        out_.push_back({t[k], t[(k + 1) % 3], middle[k]});
        out_.push_back({t[k], middle[k], t[(k + 2) % 3]});
    }

    /// Corner k is cut off; of the rest's diagonals the shorter one is taken.
    void in_three(const Triangle& t, const std::array<Index, 3>& middle, std::size_t k) {
        const Index b = t[(k + 1) % 3];
        const Index c = t[(k + 2) % 3];
        const Index on_c = middle[(k + 1) % 3]; // between k and c
        const Index on_b = middle[(k + 2) % 3]; // between k and b
        out_.push_back({t[k], on_b, on_c});
        if (length(b, on_c) <= length(c, on_b)) {
            out_.push_back({b, c, on_c});
            out_.push_back({b, on_c, on_b});
        } else {
            out_.push_back({b, c, on_b});
            out_.push_back({c, on_c, on_b});
        }
    }

    double length(Index a, Index b) const {
        return (mesh_.positions[at(a)] - mesh_.positions[at(b)]).norm();
    }

    const TriangleMesh& mesh_;
    std::vector<Triangle>& out_;
};

} // namespace

TriangleMesh split_long_edges(TriangleMesh mesh, double longest) {
    while (true) {
        const EdgeTopology topology = build_edges(mesh.triangles);
        const std::size_t before = mesh.positions.size();
        const std::vector<Index> middles = halve(mesh, topology, longest);
        if (mesh.positions.size() == before) {
            return mesh;
        }
        std::vector<Triangle> triangles;
        Pieces pieces(mesh, triangles);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const auto& edges = topology.triangle_edges[t];
            pieces.add(mesh.triangles[t],
                       {middles[at(edges[0])], middles[at(edges[1])], middles[at(edges[2])]});
        }
        mesh.triangles = std::move(triangles);
    }
}

} // namespace weft
