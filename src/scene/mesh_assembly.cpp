#include "scene/mesh_assembly.h"

#include "geometry/mesh_repair.h"
#include "geometry/weld.h"
#include "scene/joined_mesh.h"
#include "scene/rig_pose.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace weft {
namespace {

struct Unit {
    const char* name;
    double metres;
};

constexpr std::array<Unit, 4> k_units{{{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}}};

/// A warning when the largest dimension of an object lies outside 1 cm to 10 m, naming the units
/// that would make it as large as clothes and people are; "" otherwise.
///
/// @param size             largest dimension, m
/// @param metres_per_unit  what was used to get there
std::string size_warning(double size, double metres_per_unit) {
    if (!(size > 0.0) || (size >= 0.01 && size <= 10.0)) {
        return "";
    }
    std::string likely;
    for (const Unit& unit : k_units) {
        const double would_be = size / metres_per_unit * unit.metres;
        const bool is_other = std::abs(unit.metres / metres_per_unit - 1.0) > 1e-6;
        if (is_other && would_be >= 0.1 && would_be <= 3.0) {
            likely += fmt::format("{}\"{}\" ({:.3g} m)", likely.empty() ? "" : " or ", unit.name,
                                  would_be);
        }
    }
    const std::string hint = likely.empty() ? "set units or scale" : "units may be " + likely;
    return fmt::format("the largest dimension is {:.4g} m, outside 1 cm to 10 m: {}", size, hint);
}

/// "1 edge has", "3 edges have"
std::string count(std::size_t number, const char* one, const char* many) {
    return fmt::format("{} {}", number, number == 1 ? one : many);
}

/// The work of assemble_mesh(), stage by stage; each leaves the mesh usable by the next.
class MeshAssembler {
public:
    MeshAssembler(const MeshFile& file,
                  std::vector<std::size_t> chosen,
                  const MeshSource& source,
                  const std::string& name)
        : file_(file), source_(source), name_(name), chosen_(std::move(chosen)) {}

    MeshAssembly run() {
        result_.imported.warnings = file_.warnings;
        const Mat3 to_world = choose_unit_and_axes();
        count_input();
        if (!has_sound_numbers()) {
            return std::move(result_);
        }
        joined_ = join_objects(file_, chosen_, to_world);
        drop_unused();
        weld_mesh(joined_, k_weld_fraction * bounding_diagonal(joined_.mesh.positions),
                  file_.rig ? motion_groups(*file_.rig) : std::vector<Index>());
        if (source_.repair) {
            repair();
        }
        orient();
        turn_inside_out();
        check_defects();
        check_size();
        result_.imported.mesh = std::move(joined_.mesh);
        result_.imported.corner_uv = std::move(joined_.corner_uv);
        result_.imported.polygons = polygon_numbers(joined_);
        result_.imported.sources = std::move(joined_.sources);
        result_.imported.rig = file_.rig;
        return std::move(result_);
    }

private:
    template <typename... Args> void refuse(fmt::format_string<Args...> format, Args&&... args) {
        result_.refusals.push_back(name_ + ": " + fmt::format(format, std::forward<Args>(args)...));
    }

    template <typename... Args>
    void refuse_as_cloth(fmt::format_string<Args...> format, Args&&... args) {
        result_.cloth_refusals.push_back(name_ + ": " +
                                         fmt::format(format, std::forward<Args>(args)...));
    }

    template <typename... Args> void warn_that(fmt::format_string<Args...> format, Args&&... args) {
        result_.imported.warnings.push_back(fmt::format(format, std::forward<Args>(args)...));
    }

    /// What the user says counts, then what the file says, then metres and y.
    Mat3 choose_unit_and_axes() {
        const bool own_unit = !source_.units_given && file_.states_unit;
        result_.metres_per_unit = own_unit ? file_.metres_per_unit : source_.metres_per_unit;
        const bool own_up = !source_.up_given && source_.up == 'y' && file_.states_up;
        result_.up = own_up ? file_.up : source_.up;
        Mat3 turn = Mat3::Identity();
        if (own_up) {
            turn = file_.to_y_up;
        } else if (source_.up == 'z') { // x, z, -y
            turn << 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0;
        }
        result_.imported.to_world = result_.metres_per_unit * turn;
        return result_.imported.to_world;
    }

    void count_input() {
        std::size_t points_and_lines = 0;
        auto& names = result_.imported.objects;
        for (const std::size_t i : chosen_) {
            const FileObject& object = file_.objects[i];
            points_and_lines += object.points_and_lines;
            result_.imported.vertices_in_file += object.positions.size();
            result_.imported.triangles_in_file += object.triangles.size();
            if (!object.triangles.empty() &&
                std::find(names.begin(), names.end(), object.name) == names.end()) {
                names.push_back(object.name);
            }
        }
        if (points_and_lines > 0) {
            warn_that("{} left out: only faces are simulated",
                      count(points_and_lines, "point or line was", "points and lines were"));
        }
    }

    /// False when the later stages have nothing to work on.
    bool has_sound_numbers() {
        for (const std::size_t i : chosen_) {
            const FileObject& object = file_.objects[i];
            if (!object.bad_faces.empty()) {
                refuse("object \"{}\": {} a vertex that is not there: face {}", object.name,
                       count(object.bad_faces.size(), "face names", "faces name"),
                       first_few(object.bad_faces));
            }
            std::vector<Index> not_finite;
            for (std::size_t v = 0; v < object.positions.size(); ++v) {
                if (!object.positions[v].allFinite()) {
                    not_finite.push_back(static_cast<Index>(v));
                }
            }
            if (!not_finite.empty()) {
                refuse(
                    "object \"{}\": {} a coordinate that is not a finite number: vertex {} in the "
                    "file",
                    object.name, count(not_finite.size(), "vertex has", "vertices have"),
                    first_few(not_finite));
            }
        }
        if (result_.refusals.empty() && result_.imported.triangles_in_file == 0) {
            const auto& warnings = result_.imported.warnings;
            refuse("has no triangles{}{}", warnings.empty() ? "" : ": ",
                   warnings.empty() ? "" : warnings.back());
        }
        return result_.refusals.empty();
    }

    void drop_unused() {
        const std::size_t dropped = drop_unused_vertices(joined_);
        const bool has_lines = std::any_of(chosen_.begin(), chosen_.end(), [&](std::size_t i) {
            return file_.objects[i].points_and_lines > 0;
        });
        if (dropped > 0 && !has_lines) {
            warn_that("{} dropped: in no triangle", count(dropped, "vertex was", "vertices were"));
        }
    }

    void repair() {
        const MeshDefects defects = find_defects(joined_.mesh);
        std::vector<Index> bad = defects.degenerate;
        bad.insert(bad.end(), defects.duplicates.begin(), defects.duplicates.end());
        if (bad.empty()) {
            return;
        }
        std::sort(bad.begin(), bad.end());
        bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
        drop_triangles(joined_, bad);
        drop_unused_vertices(joined_);
        result_.imported.triangles_removed = bad.size();
        warn_that("repair dropped {}: {} degenerate, {} with the corners of another",
                  count(bad.size(), "triangle", "triangles"), defects.degenerate.size(),
                  defects.duplicates.size());
        if (joined_.mesh.triangles.empty()) {
            refuse("has no triangles left after repair dropped {}", bad.size());
        }
    }

    void orient() {
        const OrientReport report = orient_consistently(joined_.mesh.triangles);
        for (const Index t : report.flipped) {
            flip_corner_uv(joined_, static_cast<std::size_t>(t));
        }
        if (!report.flipped.empty()) {
            warn_that("{} wound against the neighbours and turned",
                      count(report.flipped.size(), "triangle was", "triangles were"));
        }
    }

    void turn_inside_out() {
        TriangleMesh& mesh = joined_.mesh;
        const EdgeTopology topology = build_edges(mesh.triangles);
        const bool closed = std::none_of(topology.edges.begin(), topology.edges.end(),
                                         [](const MeshEdge& e) { return e.is_boundary(); });
        if (!closed || enclosed_volume(mesh.positions, mesh.triangles) >= 0.0) {
            return;
        }
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
            flip_corner_uv(joined_, t);
        }
        warn_that("the closed surface was inside out and has been turned");
    }

    void check_defects() {
        result_.defects = find_defects(joined_.mesh);
        const MeshDefects& defects = result_.defects;
        if (!defects.degenerate.empty()) {
            refuse("{}: {} degenerate (no area, or an altitude below {:.0e} of the "
                   "size): mend the file or set repair = true",
                   place(defects.degenerate),
                   count(defects.degenerate.size(), "triangle is", "triangles are"),
                   k_least_altitude_fraction);
        }
        if (!defects.duplicates.empty()) {
            refuse_as_cloth(
                "{}: {} the same corners as another: mend the file or set repair = true",
                place(defects.duplicates),
                count(defects.duplicates.size(), "triangle has", "triangles have"));
        }
        if (!defects.non_manifold_edges.empty()) {
            refuse_as_cloth("object \"{}\": {} more than two triangles: edge {} "
                            "(vertices after welding): cloth allows one or two",
                            object_at(defects.non_manifold_edges[0]),
                            count(defects.non_manifold_edges.size(), "edge has", "edges have"),
                            first_few(defects.non_manifold_edges));
        }
        if (!defects.winding_edges.empty()) {
            refuse_as_cloth("object \"{}\": a part has one side only (a Moebius strip): at edge {} "
                            "(vertices after welding): cloth needs two",
                            object_at(defects.winding_edges[0]), first_few(defects.winding_edges));
        }
        if (!defects.pinched_vertices.empty()) {
            warn_that("{} surfaces in a single point: vertex {}",
                      count(defects.pinched_vertices.size(), "vertex joins", "vertices join"),
                      first_few(defects.pinched_vertices));
        }
    }

    /// `object "Shirt": face 3, 9 and 2 more`, of the first triangle's object.
    std::string place(const std::vector<Index>& triangles) const {
        const auto origin = [&](Index t) { return joined_.origins[static_cast<std::size_t>(t)]; };
        const std::size_t object = origin(triangles[0]).object;
        std::vector<Index> faces;
        for (const Index t : triangles) {
            const bool is_new = faces.empty() || faces.back() != origin(t).face;
            if (origin(t).object == object && is_new) {
                faces.push_back(origin(t).face);
            }
        }
        return fmt::format("object \"{}\": face {}", file_.objects[object].name, first_few(faces));
    }

    std::string object_at(const std::array<Index, 2>& edge) const {
        const auto& triangles = joined_.mesh.triangles;
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            const auto has = [&](Index v) {
                return std::find(triangles[t].begin(), triangles[t].end(), v) != triangles[t].end();
            };
            if (has(edge[0]) && has(edge[1])) {
                return file_.objects[joined_.origins[t].object].name;
            }
        }
        return "";
    }

    void check_size() {
        Eigen::AlignedBox3d box;
        for (const Vec3& p : joined_.mesh.positions) {
            box.extend(p);
        }
        const double size = box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
        const std::string warning = size_warning(size, result_.metres_per_unit);
        if (!warning.empty()) {
            result_.imported.warnings.push_back(warning);
        }
    }

    const MeshFile& file_;
    const MeshSource& source_;
    const std::string& name_;
    std::vector<std::size_t> chosen_;
    JoinedMesh joined_;
    MeshAssembly result_;
};

} // namespace

MeshAssembly assemble_mesh(const MeshFile& file,
                           std::vector<std::size_t> chosen,
                           const MeshSource& source,
                           const std::string& name) {
    return MeshAssembler(file, std::move(chosen), source, name).run();
}

} // namespace weft
