#include "app/inspect_mesh.h"

#include "app/summary.h"
#include "base/error.h"
#include "geometry/crossing.h"
#include "geometry/mesh_measure.h"
#include "scene/mesh_import.h"

#include <fmt/core.h>

#include <algorithm>
#include <numbers>

namespace weft {

namespace {

/// A length that may be tiny beside the object's size: in mm below 10 cm.
std::string short_length(double metres) {
    return metres < 0.1 ? fmt::format("{:.3g} mm", 1000.0 * metres)
                        : fmt::format("{:.3f} m", metres);
}

/// Objects that share a node's name, as one row of the table.
struct Group {
    std::string name;
    std::vector<std::size_t> members;
};

std::vector<Group> group_objects(const MeshFile& file, const std::vector<std::size_t>& chosen) {
    std::vector<Group> groups;
    for (const std::size_t i : chosen) {
        const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
            return g.name == file.objects[i].name;
        });
        if (same == groups.end()) {
            groups.push_back({file.objects[i].name, {i}});
        } else {
            same->members.push_back(i);
        }
    }
    return groups;
}

std::string unit_words(const MeshFile& file, const MeshSource& source, const MeshAssembly& mesh) {
    const char* who = source.units_given ? "as asked"
                      : file.states_unit ? "says the file"
                                         : "assumed";
    const bool own_up = !source.up_given && source.up == 'y';
    const char* who_up = !own_up ? "as asked" : file.states_up ? "says the file" : "assumed";
    return fmt::format("1 unit = {:.6g} m ({}), {} is up ({})", mesh.metres_per_unit, who, mesh.up,
                       who_up);
}

void list_objects(const MeshFile& file,
                  const std::vector<std::size_t>& chosen,
                  const MeshSource& source,
                  const std::string& name,
                  SummaryLines& sheet) {
    const std::vector<Group> groups = group_objects(file, chosen);
    std::size_t width = 8;
    for (const Group& group : groups) {
        width = std::max(width, group.name.size());
    }
    sheet.row("objects", "{:<{}}  {:>9}  {:>9}  {:>9}  {:>5}  {:>5}  {:>7}  {}", "name", width,
              "vertices", "welded", "triangles", "parts", "loops", "largest", "uv");
    for (const Group& group : groups) {
        const MeshAssembly mesh = assemble_mesh(file, group.members, source, name);
        const ImportedMesh& m = mesh.imported;
        const MeshMeasure measure = measure_mesh(m.mesh);
        sheet.row("", "{:<{}}  {:>9}  {:>9}  {:>9}  {:>5}  {:>5}  {:>5.3g} m  {}", group.name,
                  width, m.vertices_in_file, m.mesh.positions.size(), m.triangles_in_file,
                  measure.parts, measure.loops.size(), measure.largest_dimension(),
                  m.corner_uv.empty() ? "-" : "yes");
    }
}

void describe_boundary(const MeshMeasure& m, SummaryLines& sheet) {
    if (m.is_closed) {
        sheet.row("boundary", "none: closed");
        return;
    }
    constexpr std::size_t k_listed = 12;
    for (std::size_t i = 0; i < std::min(m.loops.size(), k_listed); ++i) {
        const std::string label = i == 0 ? plural(m.loops.size(), "loop") : "";
        sheet.row(i == 0 ? "boundary" : "", "{:<10}{:>5} edges, {}", label, m.loops[i].edges,
                  short_length(m.loops[i].length));
    }
    if (m.loops.size() > k_listed) {
        sheet.row("", "and {} shorter ones", m.loops.size() - k_listed);
    }
}

void describe_shape(const MeshMeasure& m, SummaryLines& sheet) {
    const Vec3 size = m.high - m.low;
    sheet.row("size", "{:.4g} x {:.4g} x {:.4g} m (x, y, z), from ({:.4g}, {:.4g}, {:.4g})",
              size.x(), size.y(), size.z(), m.low.x(), m.low.y(), m.low.z());
    describe_boundary(m, sheet);
    sheet.row("edges", "{}: least {}, mean {}, greatest {}", m.edges, short_length(m.edge_min),
              short_length(m.edge_mean), short_length(m.edge_max));
    sheet.row("thinnest", "angle {:.3g} deg (triangle {}), altitude {} (triangle {})",
              m.least_angle * 180.0 / std::numbers::pi, m.least_angle_triangle,
              short_length(m.least_altitude), m.least_altitude_triangle);
    sheet.row("area", "{:.4g} m^2", m.area);
    if (m.is_closed) {
        sheet.row("volume", "{:.4g} m^3", m.volume);
    }
}

void describe_uv(const ImportedMesh& m, SummaryLines& sheet) {
    if (m.corner_uv.empty()) {
        sheet.row("uv", "none");
        return;
    }
    const UvMeasure uv = measure_uv(m.mesh.triangles, m.corner_uv);
    sheet.row("uv", "{} of the pattern, {} along seams",
              plural(static_cast<std::size_t>(uv.islands), "island"),
              plural(uv.seam_edges, "inner edge"));
}

void describe_counts(const MeshAssembly& mesh, int parts, SummaryLines& sheet) {
    const ImportedMesh& m = mesh.imported;
    sheet.row("vertices", "{} in the file, {} after welding", m.vertices_in_file,
              m.mesh.positions.size());
    sheet.row("triangles", "{} in {}{}", m.mesh.triangles.size(),
              plural(static_cast<std::size_t>(parts), "part"),
              m.triangles_removed > 0 ? fmt::format(" ({} dropped)", m.triangles_removed) : "");
}

void describe_defects(const MeshAssembly& mesh, SummaryLines& sheet) {
    const MeshDefects& d = mesh.defects;
    const char* label = "defects";
    const auto say = [&](const char* what, const auto& elements) {
        if (!elements.empty()) {
            sheet.row(label, "{} {}: {}", elements.size(), what, first_few(elements));
            label = "";
        }
    };
    say("degenerate triangles", d.degenerate);
    say("triangles with the corners of another", d.duplicates);
    say("edges with more than two triangles", d.non_manifold_edges);
    say("edges where the winding breaks", d.winding_edges);
    if (label[0] != '\0') {
        sheet.row(label, "none");
    }
    const auto crossings = find_self_crossings(mesh.imported.mesh);
    if (crossings.empty()) {
        sheet.row("crossings", "none");
    } else {
        sheet.row("crossings", "{} of triangles: {}", plural(crossings.size(), "pair"),
                  first_few(crossings));
    }
    for (const std::string& warning : mesh.imported.warnings) {
        sheet.row("warning", "{}", warning);
    }
}

/// A refusal without the file's name, which stands above it.
std::string without_name(const std::string& refusal, const std::string& name) {
    return refusal.starts_with(name + ": ") ? refusal.substr(name.size() + 2) : refusal;
}

std::string name_of(const Animation& animation) {
    return animation.name.empty() ? "(no name)" : fmt::format("\"{}\"", animation.name);
}

/// What moves in a mesh file, a row an animation: name, duration, nodes, bones, morph targets.
///
/// @param chosen  objects of the file that are looked at
void describe_animations(const Rig& rig, std::span<const std::size_t> chosen, SummaryLines& sheet) {
    std::vector<Index> bones;
    std::size_t targets = 0;
    for (const std::size_t i : chosen) {
        const RigPart& part = rig.parts[i];
        for (std::size_t b = 0; b + 1 < part.bones.size(); ++b) { // the last stands for none
            bones.push_back(part.bones[b].node);
        }
        targets += part.targets.size();
    }
    std::sort(bones.begin(), bones.end());
    bones.erase(std::unique(bones.begin(), bones.end()), bones.end());
    const char* label = "animations";
    for (const Animation& animation : rig.animations) {
        sheet.row(label, "{}: {:.4g} s, moves {}; {}, {}", name_of(animation), animation.duration,
                  plural(animation.channels.size(), "node"), plural(bones.size(), "bone"),
                  plural(targets, "morph target"));
        label = "";
    }
    for (const std::string& warning : rig.warnings) {
        sheet.row("warning", "{}", warning);
    }
}

InspectReport describe_read_file(const MeshFile& file,
                                 const MeshSource& source,
                                 bool as_cloth,
                                 SummaryLines sheet) {
    const std::vector<std::size_t> chosen = choose_objects(file, source.objects, source.file);
    const MeshAssembly mesh = assemble_mesh(file, chosen, source, source.file);
    sheet.row("format", "{}", file.format.empty() ? "not named" : file.format);
    sheet.row("unit, up", "{}", unit_words(file, source, mesh));
    list_objects(file, chosen, source, source.file, sheet);
    if (file.rig) {
        describe_animations(*file.rig, chosen, sheet);
    }
    if (!mesh.imported.mesh.triangles.empty()) {
        const MeshMeasure measure = measure_mesh(mesh.imported.mesh);
        describe_counts(mesh, measure.parts, sheet);
        describe_shape(measure, sheet);
        describe_uv(mesh.imported, sheet);
        describe_defects(mesh, sheet);
    }
    for (const std::string& refusal : mesh.refusals) {
        sheet.row("REFUSED", "{}", without_name(refusal, source.file));
    }
    for (const std::string& refusal : mesh.cloth_refusals) {
        sheet.row(as_cloth ? "REFUSED" : "not as cloth", "{}", without_name(refusal, source.file));
    }
    return {sheet.text, !mesh.refusals.empty() || (as_cloth && !mesh.cloth_refusals.empty())};
}

} // namespace

InspectReport
describe_mesh_file(const std::filesystem::path& file, const MeshSource& source, bool as_cloth) {
    SummaryLines sheet;
    sheet.text = source.file + "\n";
    try {
        return describe_read_file(read_mesh_file(file, source.file), source, as_cloth, sheet);
    } catch (const Error& error) {
        sheet.row("REFUSED", "{}", without_name(error.what(), source.file));
        return {sheet.text, true};
    }
}

} // namespace weft
