#include "scene/mesh_assembly.h"

#include "geometry/mesh_repair.h"
#include "geometry/weld.h"
#include "scene/likely_unit.h"
#include "scene/object_choice.h"

#include <fmt/core.h>

#include <algorithm>

namespace weft {

namespace {

/// Where a triangle of the assembled mesh came from.
struct Origin {
    std::size_t object; ///< in MeshFile::objects
    Index face;         ///< in that object's mesh, from 0
};

/// The work of assemble_mesh(), stage by stage; each leaves the mesh usable by the next.
class Assembler {
public:
    Assembler(const MeshFile& file, const MeshSource& source, const std::string& name, bool cloth)
        : file_(file), source_(source), name_(name), cloth_(cloth) {
        const bool own_unit = !source.units_given && file.states_unit;
        result_.metres_per_unit = own_unit ? file.metres_per_unit : source.metres_per_unit;
        const bool own_up = !source.up_given && source.up == 'y' && file.states_up;
        result_.up = own_up ? file.up : source.up;
        to_world_ = result_.metres_per_unit * (own_up ? file.to_y_up : turn_up(source.up));
    }

    MeshAssembly run() {
        result_.imported.warnings = file_.warnings;
        chosen_ = choose_objects(file_, source_.objects, name_);
        name_objects();
        if (check_numbers()) {
            join_objects();
            weld();
            find_and_repair();
            orient();
            check_defects();
            check_size();
        }
        return std::move(result_);
    }

private:
    static Mat3 turn_up(char up) {
        Mat3 turn = Mat3::Identity();
        if (up == 'z') { // x, z, -y
            turn << 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0;
        }
        return turn;
    }

    template <typename... Args> void refuse(fmt::format_string<Args...> format, Args&&... args) {
        result_.refusals.push_back(name_ + ": " + fmt::format(format, std::forward<Args>(args)...));
    }

    template <typename... Args> void warn_that(fmt::format_string<Args...> format, Args&&... args) {
        result_.imported.warnings.push_back(fmt::format(format, std::forward<Args>(args)...));
    }

    void name_objects() {
        std::size_t points_and_lines = 0;
        for (const std::size_t i : chosen_) {
            const FileObject& object = file_.objects[i];
            points_and_lines += object.points_and_lines;
            result_.imported.vertices_in_file += object.positions.size();
            result_.imported.triangles_in_file += object.triangles.size();
            auto& names = result_.imported.objects;
            if (!object.triangles.empty() &&
                std::find(names.begin(), names.end(), object.name) == names.end()) {
                names.push_back(object.name);
            }
        }
        if (points_and_lines > 0) {
            warn_that("{} points and lines were left out: only faces are simulated",
                      points_and_lines);
        }
    }

    /// False when what follows has nothing sound to work on.
    bool check_numbers() {
        for (const std::size_t i : chosen_) {
            const FileObject& object = file_.objects[i];
            if (!object.bad_faces.empty()) {
                refuse("object \"{}\": {} faces name a vertex that is not there: face {}",
                       object.name, object.bad_faces.size(), first_few(object.bad_faces));
            }
            std::vector<Index> not_finite;
            for (std::size_t v = 0; v < object.positions.size(); ++v) {
                if (!object.positions[v].allFinite()) {
                    not_finite.push_back(static_cast<Index>(v));
                }
            }
            if (!not_finite.empty()) {
                refuse("object \"{}\": {} vertices have a coordinate that is not a finite number: "
                       "vertex {} in the file",
                       object.name, not_finite.size(), first_few(not_finite));
            }
        }
        if (result_.refusals.empty() && result_.imported.triangles_in_file == 0) {
            refuse("has no triangles{}", result_.imported.warnings.empty()
                                             ? ""
                                             : ": " + result_.imported.warnings.back());
        }
        return result_.refusals.empty();
    }

    /// All chosen objects behind one another, without the vertices that no triangle uses.
    void join_objects() {
        ImportedMesh& out = result_.imported;
        const bool all_have_uv = std::all_of(chosen_.begin(), chosen_.end(), [&](std::size_t i) {
            const FileObject& object = file_.objects[i];
            return object.triangles.empty() || !object.corner_uv.empty();
        });
        std::size_t unused = 0;
        for (const std::size_t i : chosen_) {
            const FileObject& object = file_.objects[i];
            const auto first = static_cast<Index>(out.mesh.positions.size());
            for (const Vec3& p : object.positions) {
                out.mesh.positions.emplace_back(to_world_ * p);
            }
            for (std::size_t t = 0; t < object.triangles.size(); ++t) {
                const Triangle& corners = object.triangles[t];
                out.mesh.triangles.push_back(
                    {corners[0] + first, corners[1] + first, corners[2] + first});
                origins_.push_back({i, object.face_of_triangle[t]});
            }
            if (all_have_uv) {
                out.corner_uv.insert(out.corner_uv.end(), object.corner_uv.begin(),
                                     object.corner_uv.end());
            }
            unused += object.points_and_lines == 0 ? count_unused(object) : 0;
        }
        if (unused > 0) {
            warn_that("{} vertices that no triangle uses were dropped", unused);
        }
        drop_unused_vertices();
    }

    static std::size_t count_unused(const FileObject& object) {
        std::vector<char> used(object.positions.size(), 0);
        for (const Triangle& t : object.triangles) {
            for (const Index v : t) {
                used[static_cast<std::size_t>(v)] = 1;
            }
        }
        return static_cast<std::size_t>(std::count(used.begin(), used.end(), 0));
    }

    void drop_unused_vertices() {
        TriangleMesh& mesh = result_.imported.mesh;
        std::vector<Index> new_index(mesh.positions.size(), k_no_index);
        for (const Triangle& t : mesh.triangles) {
            for (const Index v : t) {
                new_index[static_cast<std::size_t>(v)] = 0;
            }
        }
        Index kept = 0;
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            if (new_index[v] != k_no_index) {
                mesh.positions[static_cast<std::size_t>(kept)] = mesh.positions[v];
                new_index[v] = kept++;
            }
        }
        mesh.positions.resize(static_cast<std::size_t>(kept));
        renumber(new_index);
    }

    void renumber(const std::vector<Index>& new_index) {
        for (Triangle& t : result_.imported.mesh.triangles) {
            for (Index& v : t) {
                v = new_index[static_cast<std::size_t>(v)];
            }
        }
    }

    void weld() {
        TriangleMesh& mesh = result_.imported.mesh;
        const double tolerance = k_weld_share * bounding_diagonal(mesh.positions);
        Weld welded = weld_vertices(mesh.positions, tolerance);
        mesh.positions = std::move(welded.positions);
        renumber(welded.new_index);
    }

    void find_and_repair() {
        ImportedMesh& out = result_.imported;
        result_.defects = find_defects(out.mesh);
        std::vector<Index> bad = result_.defects.degenerate;
        bad.insert(bad.end(), result_.defects.duplicates.begin(), result_.defects.duplicates.end());
        if (!source_.repair || bad.empty()) {
            return;
        }
        warn_that("repair dropped {} degenerate and {} double triangles",
                  result_.defects.degenerate.size(), result_.defects.duplicates.size());
        std::sort(bad.begin(), bad.end());
        drop_triangles(bad);
        out.triangles_removed = bad.size();
        drop_unused_vertices();
        if (out.mesh.triangles.empty()) {
            refuse("has no triangles left after repair dropped {}", bad.size());
        }
    }

    void drop_triangles(const std::vector<Index>& ascending) {
        ImportedMesh& out = result_.imported;
        std::size_t kept = 0;
        auto next = ascending.begin();
        for (std::size_t t = 0; t < out.mesh.triangles.size(); ++t) {
            if (next != ascending.end() && static_cast<std::size_t>(*next) == t) {
                ++next;
                continue;
            }
            out.mesh.triangles[kept] = out.mesh.triangles[t];
            origins_[kept] = origins_[t];
            if (!out.corner_uv.empty()) {
                out.corner_uv[kept] = out.corner_uv[t];
            }
            ++kept;
        }
        out.mesh.triangles.resize(kept);
        origins_.resize(kept);
        out.corner_uv.resize(out.corner_uv.empty() ? 0 : kept);
    }

    void orient() {
        ImportedMesh& out = result_.imported;
        const OrientReport report = orient_consistently(out.mesh.triangles);
        for (const Index t : report.flipped) {
            swap_corner_uv(static_cast<std::size_t>(t));
        }
        if (!report.flipped.empty()) {
            warn_that("{} triangles were wound against their neighbours and have been turned",
                      report.flipped.size());
        }
        if (cloth_ && !report.is_orientable) {
            refuse("a part has one side only (a Moebius strip): cloth needs two");
        }
        result_.defects = find_defects(out.mesh);
        const EdgeTopology topology = build_edges(out.mesh.triangles);
        const bool closed = std::none_of(topology.edges.begin(), topology.edges.end(),
                                         [](const MeshEdge& e) { return e.is_boundary(); });
        if (closed && enclosed_volume(out.mesh.positions, out.mesh.triangles) < 0.0) {
            for (std::size_t t = 0; t < out.mesh.triangles.size(); ++t) {
                std::swap(out.mesh.triangles[t][1], out.mesh.triangles[t][2]);
                swap_corner_uv(t);
            }
            warn_that("the closed surface was inside out and has been turned");
        }
    }

    void swap_corner_uv(std::size_t t) {
        auto& uv = result_.imported.corner_uv;
        if (!uv.empty()) {
            std::swap(uv[t][1], uv[t][2]);
        }
    }

    /// `object "Shirt": face 3, 9 and 2 more`, by the first triangle's object.
    std::string place(const std::vector<Index>& triangles) const {
        const std::size_t object = origins_[static_cast<std::size_t>(triangles[0])].object;
        std::vector<Index> faces;
        for (const Index t : triangles) {
            const Origin& origin = origins_[static_cast<std::size_t>(t)];
            const bool is_new = faces.empty() || faces.back() != origin.face;
            if (origin.object == object && is_new) {
                faces.push_back(origin.face);
            }
        }
        return fmt::format("object \"{}\": face {}", file_.objects[object].name, first_few(faces));
    }

    std::string object_of_edge(const std::array<Index, 2>& edge) const {
        const auto& triangles = result_.imported.mesh.triangles;
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            const auto has = [&](Index v) {
                return std::find(triangles[t].begin(), triangles[t].end(), v) != triangles[t].end();
            };
            if (has(edge[0]) && has(edge[1])) {
                return file_.objects[origins_[t].object].name;
            }
        }
        return "";
    }

    void check_defects() {
        const MeshDefects& defects = result_.defects;
        if (!defects.degenerate.empty()) {
            refuse("{}: {} triangles are degenerate (no area, or an altitude below {:.1g} of the "
                   "size): mend the file or set repair = true",
                   place(defects.degenerate), defects.degenerate.size(), k_least_altitude_share);
        }
        if (!defects.duplicates.empty() && cloth_) {
            refuse("{}: {} triangles have the same corners as another: mend the file or set "
                   "repair = true",
                   place(defects.duplicates), defects.duplicates.size());
        }
        if (!defects.non_manifold_edges.empty() && cloth_) {
            refuse("object \"{}\": {} edges have more than two triangles: edge {} (welded vertex "
                   "numbers): cloth allows one or two",
                   object_of_edge(defects.non_manifold_edges[0]), defects.non_manifold_edges.size(),
                   first_few(defects.non_manifold_edges));
        }
        if (!defects.pinched_vertices.empty()) {
            warn_that("{} vertices join surfaces in a single point: vertex {}",
                      defects.pinched_vertices.size(), first_few(defects.pinched_vertices));
        }
    }

    void check_size() {
        Eigen::AlignedBox3d box;
        for (const Vec3& p : result_.imported.mesh.positions) {
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
    bool cloth_;
    Mat3 to_world_;
    std::vector<std::size_t> chosen_;
    std::vector<Origin> origins_; ///< of each triangle
    MeshAssembly result_{};
};

} // namespace

MeshAssembly
assemble_mesh(const MeshFile& file, const MeshSource& source, const std::string& name, bool cloth) {
    return Assembler(file, source, name, cloth).run();
}

} // namespace weft
