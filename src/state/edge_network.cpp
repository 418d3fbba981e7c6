#include "state/edge_network.h"

#include "state/calibrate_network.h"
#include "state/cloth.h"

#include <algorithm>
#include <cassert>
#include <set>
#include <unordered_map>

namespace weft {

namespace {

/// Gathers edges, each pair of vertices once.
class NetworkBuilder {
public:
    NetworkBuilder(const Cloth& cloth, std::span<const Index> polygons)
        : cloth_(cloth), spring_(cloth.params.spring), polygons_(polygons) {
        for (const Index polygon : polygons) {
            ++triangles_of_polygon_[polygon];
        }
    }

    EdgeNetwork build() {
        if (cloth_.params.model != Model::StvkTriangle) {
            add_mesh_edges();
            add_crossings();
        }
        if (spring_.bend > 0.0) {
            if (cloth_.params.mesh.file.empty()) {
                add_grid_bending();
            } else {
                add_mesh_bending();
            }
        }
        return std::move(network_);
    }

private:
    bool cuts_quad(const MeshEdge& edge) const {
        return !edge.is_boundary() &&
               polygons_[at(edge.triangle[0])] == polygons_[at(edge.triangle[1])] &&
               triangles_of_polygon_.at(polygons_[at(edge.triangle[0])]) == 2;
    }

    void add(Index a, Index b, double length, double stiffness, EdgeKind kind) {
        if (a != b && length > 0.0 && stiffness > 0.0 &&
            taken_.insert({std::min(a, b), std::max(a, b)}).second) {
            network_.push_back({{a, b}, length, stiffness, kind});
        }
    }

    /// Mean over the triangles at an edge, which differ where the rest shape is a pattern.
    double side_length(const MeshEdge& edge) const {
        double sum = 0.0;
        int count = 0;
        for (const Index t : edge.triangle) {
            if (t != k_no_index) {
                sum += rest_edge_length(cloth_.rest[at(t)], opposite_corner(t, edge));
                ++count;
            }
        }
        return sum / count;
    }

    int opposite_corner(Index t, const MeshEdge& edge) const {
        const Triangle& triangle = cloth_.triangles[at(t)];
        for (int k = 0; k < 3; ++k) {
            const Index v = triangle[static_cast<std::size_t>(k)];
            if (v != edge.v[0] && v != edge.v[1]) {
                return k;
            }
        }
        return 0;
    }

    /// Distance of the apexes when both triangles lie flat.
    double apex_distance(const MeshEdge& edge) const {
        Vec2 apex[2];
        for (std::size_t side = 0; side < 2; ++side) {
            const Index t = edge.triangle[side];
            const auto corners = rest_corners(cloth_.rest[at(t)]);
            const Triangle& triangle = cloth_.triangles[at(t)];
            const auto corner = [&](Index v) {
                return corners[at(static_cast<Index>(
                    std::find(triangle.begin(), triangle.end(), v) - triangle.begin()))];
            };
            const Vec2 along = corner(edge.v[1]) - corner(edge.v[0]);
            const Vec2 to_apex = corner(edge.apex[side]) - corner(edge.v[0]);
            const Vec2 unit = along.normalized();
            const double height = std::abs(unit.x() * to_apex.y() - unit.y() * to_apex.x());
            // from the middle, as the edge may be of different lengths in the two
            apex[side] = {unit.dot(to_apex) - 0.5 * along.norm(), side == 0 ? height : -height};
        }
        return (apex[0] - apex[1]).norm();
    }

    void add_mesh_edges() {
        for (const MeshEdge& edge : cloth_.topology.edges) {
            const bool is_diagonal = cuts_quad(edge);
            add(edge.v[0], edge.v[1], side_length(edge),
                is_diagonal ? spring_.K * spring_.shear : spring_.K,
                is_diagonal ? EdgeKind::Diagonal : EdgeKind::Side);
        }
    }

    void add_crossings() {
        for (const MeshEdge& edge : cloth_.topology.edges) {
            if (cuts_quad(edge)) {
                add(edge.apex[0], edge.apex[1], apex_distance(edge), spring_.K * spring_.shear,
                    EdgeKind::Diagonal);
            }
        }
    }

    void add_mesh_bending() {
        for (const MeshEdge& edge : cloth_.topology.edges) {
            if (!edge.is_boundary() && !cuts_quad(edge)) {
                add(edge.apex[0], edge.apex[1], apex_distance(edge), spring_.bend,
                    EdgeKind::Bending);
            }
        }
    }

    void add_grid_bending() {
        const std::array<int, 2> cells = cloth_.params.grid_cells;
        const Vec2 step(cloth_.params.grid_size.x() / cells[0],
                        cloth_.params.grid_size.y() / cells[1]);
        const double scale = rest_scale();
        const int row = cells[0] + 1;
        for (int j = 0; j <= cells[1]; ++j) {
            for (int i = 0; i < row; ++i) {
                const Index v = j * row + i;
                if (i + 2 < row) {
                    add(v, v + 2, 2.0 * scale * step.x(), spring_.bend, EdgeKind::Bending);
                }
                if (j + 2 <= cells[1]) {
                    add(v, v + 2 * row, 2.0 * scale * step.y(), spring_.bend, EdgeKind::Bending);
                }
            }
        }
    }

    /// A grid's rest shape is the grid, scaled.
    double rest_scale() const {
        double area = 0.0;
        for (const RestTriangle& t : cloth_.rest) {
            area += t.area;
        }
        return std::sqrt(area / (cloth_.params.grid_size.x() * cloth_.params.grid_size.y()));
    }

    const Cloth& cloth_;
    const SpringParams& spring_;
    std::span<const Index> polygons_;
    std::unordered_map<Index, int> triangles_of_polygon_; // looked up, never walked through
    std::set<std::array<Index, 2>> taken_;
    EdgeNetwork network_;
};

} // namespace

EdgeNetwork cloth_network(const Cloth& cloth, std::span<const Index> polygons) {
    assert(polygons.size() == cloth.triangles.size());
    EdgeNetwork network = NetworkBuilder(cloth, polygons).build();
    if (cloth.params.spring.calibrate && cloth.params.model != Model::StvkTriangle) {
        calibrate_network(cloth, polygons, network);
    }
    return network;
}

} // namespace weft
