#include "base/error.h"
#include "geometry/crossing.h"
#include "geometry/lattice_fill.h"
#include "geometry/mesh_repair.h"
#include "scene/pose.h"
#include "state/build_world.h"

#include <numeric>

namespace weft {

namespace {

std::string place_text(const Vec3& x) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", x.x(), x.y(), x.z());
}

/// Cells of a lattice, inside or not; more is a slip in the spacing.
constexpr double k_most_cells = 1e8;

/// Checks and scales the imported surface of a solid and fills it with particles.
class SurfaceFiller {
public:
    explicit SurfaceFiller(const SolidParams& params)
        : params_(params), place_(fmt::format("solid '{}': {}", params.name, params.mesh.file)) {}

    LatticeFill fill(TriangleMesh imported) const {
        const TriangleMesh mesh = prepared(std::move(imported));
        const LatticeRaster raster = params_.fills_open ? raster_by_winding(mesh, params_.spacing)
                                                        : raster_closed(mesh, params_.spacing);
        LatticeFill filled = fill_lattice(raster, mesh);
        if (std::accumulate(filled.volumes.begin(), filled.volumes.end(), 0.0) <= 0.0) {
            fail_input("{}: has nothing inside: must be closed, or around something with few holes",
                       place_);
        }
        return filled;
    }

private:
    TriangleMesh prepared(TriangleMesh mesh) const {
        for (Vec3& x : mesh.positions) {
            x *= params_.placement.scale;
        }
        refuse_crossing(mesh);
        const bool is_closed = check_closed(mesh);
        refuse_fine_lattice(mesh);
        is_closed ? orient_parts(mesh) : orient_open(mesh);
        return split_long_edges(std::move(mesh), k_longest_edge * params_.spacing);
    }

    void refuse_crossing(const TriangleMesh& mesh) const {
        const auto crossings = find_self_crossings(mesh);
        if (crossings.empty()) {
            return;
        }
        const auto [s, t] = crossings[0];
        fail_input("{}: crosses itself: triangles {} and {} at {}{}: must not, to be filled and to "
                   "touch others",
                   place_, s, t,
                   place_text(crossing_place(mesh.triangles[at(s)], mesh.triangles[at(t)],
                                             mesh.positions)),
                   crossings.size() > 1 ? fmt::format(" and {} pairs more", crossings.size() - 1)
                                        : "");
    }

    bool check_closed(const TriangleMesh& mesh) const {
        std::size_t open = 0;
        std::string first;
        for (const MeshEdge& edge : build_edges(mesh.triangles).edges) {
            if (edge.is_boundary() && open++ == 0) {
                first = fmt::format("{}-{} at {}", edge.v[0], edge.v[1],
                                    place_text(0.5 * (mesh.positions[at(edge.v[0])] +
                                                      mesh.positions[at(edge.v[1])])));
            }
        }
        if (open > 0 && !params_.fills_open) {
            fail_input("{}: is open at edge {}{}: must be closed, or fill = \"winding\"", place_,
                       first, open > 1 ? fmt::format(" and {} more", open - 1) : "");
        }
        return open == 0;
    }

    /// An open mesh is wound outward as a whole when it mostly faces away from its middle.
    static void orient_open(TriangleMesh& mesh) {
        const Vec3 sum =
            std::accumulate(mesh.positions.begin(), mesh.positions.end(), Vec3::Zero().eval());
        const Vec3 middle = sum / static_cast<double>(mesh.positions.size());
        double volume = 0.0;
        for (const Triangle& t : mesh.triangles) {
            const auto x = [&](std::size_t k) { return Vec3(mesh.positions[at(t[k])] - middle); };
            volume += x(0).dot(x(1).cross(x(2)));
        }
        for (Triangle& t : mesh.triangles) {
            if (volume < 0.0) {
                std::swap(t[1], t[2]);
            }
        }
    }

    void refuse_fine_lattice(const TriangleMesh& mesh) const {
        Eigen::AlignedBox3d box;
        for (const Vec3& x : mesh.positions) {
            box.extend(x);
        }
        const Vec3 cells = (box.sizes() / params_.spacing).cwiseMax(1.0);
        if (cells.prod() > k_most_cells) {
            fail_input("{}: spacing = {}: must be at least {:.2g} m for this mesh of {:.3g} x "
                       "{:.3g} x {:.3g} m",
                       place_, params_.spacing,
                       params_.spacing * std::cbrt(cells.prod() / k_most_cells), box.sizes().x(),
                       box.sizes().y(), box.sizes().z());
        }
    }

    const SolidParams& params_;
    std::string place_;
};

LatticeFill fill_whole_box(const SolidParams& params) {
    std::array<int, 3> cells{};
    double count = 1.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double along = params.box[static_cast<Eigen::Index>(k)] * params.placement.scale;
        count *= std::round(along / params.spacing);
        cells[k] = static_cast<int>(std::round(along / params.spacing));
    }
    if (count > k_most_cells) {
        fail_input("solid '{}': spacing = {}: makes {:.3g} cells: must make at most {:.0e}",
                   params.name, params.spacing, count, k_most_cells);
    }
    return fill_box(cells, params.spacing);
}

EdgeNetwork make_network(const LatticeFill& fill, const SpringParams& spring) {
    EdgeNetwork network;
    for (const LatticeEdge& edge : lattice_edges(fill)) {
        const bool is_side = edge.kind == LatticeEdgeKind::Side;
        const double stiffness = is_side ? spring.K : spring.shear * spring.K;
        if (stiffness > 0.0) {
            const auto [a, b] = edge.particles;
            network.push_back(
                {.vertices = edge.particles,
                 .rest_length = (fill.particles[at(a)] - fill.particles[at(b)]).norm(),
                 .stiffness = stiffness,
                 .kind = is_side ? EdgeKind::Side : EdgeKind::Diagonal});
        }
    }
    return network;
}

Body make_body(const World& world, const SolidParams& params, LatticeFill& fill) {
    Body body;
    body.name = params.name;
    body.first_vertex = static_cast<Index>(world.positions.size());
    body.vertex_count = static_cast<Index>(fill.places.size());
    body.first_particle = body.first_vertex + body.vertex_count;
    body.particle_count = static_cast<Index>(fill.particles.size());
    body.triangles = std::move(fill.surface.triangles);
    body.topology = build_edges(body.triangles);
    for (const LatticePlace& place : fill.places) {
        body.embeddings.push_back({place.particles, place.weights});
    }
    body.thickness = params.thickness;
    body.friction = params.friction;
    body.static_friction = params.static_friction.value_or(params.friction);
    return body;
}

} // namespace

Solid& add_solid(World& world, const SolidParams& params, const ImportedMesh& imported) {
    LatticeFill fill = params.mesh.file.empty() ? fill_whole_box(params)
                                                : SurfaceFiller(params).fill(imported.mesh);
    const std::vector<double> masses = lattice_masses(fill, params.spring.mass);
    Solid solid;
    solid.params = params;
    solid.network = make_network(fill, params.spring);
    solid.body = make_body(world, params, fill);
    solid.cells = std::move(fill.cells);
    solid.rest_positions = std::move(fill.particles);

    const std::size_t vertices = at(solid.body.vertex_count);
    world.positions.resize(world.positions.size() + vertices, Vec3::Zero());
    world.masses.resize(world.masses.size() + vertices, 0.0);
    const Placement unscaled{params.placement.translate, params.placement.rotate_deg, 1.0};
    for (std::size_t i = 0; i < solid.rest_positions.size(); ++i) {
        world.positions.push_back(place(unscaled, solid.rest_positions[i]));
        world.masses.push_back(masses[i]);
    }
    world.velocities.resize(world.positions.size(), params.velocity);
    interpolate_embedded(solid.body, world.positions);
    extend_history(world);
    return world.solids.emplace_back(std::move(solid));
}

} // namespace weft
