#include "app/inspect_scene.h"

#include "app/crossing_ply.h"
#include "app/inspect_mesh.h"
#include "app/summary.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "collide/crossings.h"
#include "frames/measures.h"
#include "scene/law_shape.h"
#include "scene/mesh_sequence.h"
#include "scene/scene_reader.h"
#include "start/start_overlap.h"
#include "state/build_world.h"
#include "state/world.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

namespace weft {

namespace {

std::string describe_solids(const World& world) {
    SummaryLines sheet;
    for (const Solid& solid : world.solids) {
        const Body& body = solid.body;
        const auto begin = world.masses.begin() + body.first_particle;
        sheet.row("filled", "{}: {} particles, {} cells, {} edges, {:.4g} litres, {:.4g} kg",
                  body.name, body.particle_count, solid.cells.size(), solid.network.size(),
                  1e3 * body_volume(world, body),
                  std::accumulate(begin, begin + body.particle_count, 0.0));
    }
    return sheet.text;
}

/// Pairs listed of each two objects; the count tells of the rest.
constexpr std::size_t k_listed = 5;

using Couples = std::map<std::array<ObjectId, 2>, std::vector<UnresolvedPair>>;

void list_pairs(const World& world, const Couples& couples, bool all, SummaryLines& sheet) {
    for (const auto& [objects, pairs] : couples) {
        const std::string a = object_name(world, objects[0]);
        const std::string b = object_name(world, objects[1]);
        if (objects[0] == objects[1]) {
            sheet.row("", "{}: {} with itself", a, plural(pairs.size(), "pair"));
        } else {
            sheet.row("", "{} and {}: {}", a, b, plural(pairs.size(), "pair"));
        }
        const std::size_t listed = all ? pairs.size() : std::min(pairs.size(), k_listed);
        for (const UnresolvedPair& pair : std::span(pairs).first(listed)) {
            sheet.row("", "  {} triangle {:<6} {} triangle {:<6} at ({:.4f}, {:.4f}, {:.4f}) m", a,
                      pair.triangles[0], b, pair.triangles[1], pair.place.x(), pair.place.y(),
                      pair.place.z());
        }
        if (listed < pairs.size()) {
            sheet.row("", "  and {} more: --pairs lists all", pairs.size() - listed);
        }
    }
}

const char* what_is_done(StartOverlap way) {
    switch (way) {
    case StartOverlap::Grow:
        return "contact.start_overlap = \"grow\" will part them";
    case StartOverlap::Untangle:
        return "contact.start_overlap = \"untangle\" will part them";
    case StartOverlap::Error:
        break;
    }
    return "must be apart, or contact.start_overlap = \"untangle\" or \"grow\"";
}

const std::string& cloth_name(const World& world, Index cloth) {
    return world.cloths[static_cast<std::size_t>(cloth)].name;
}

void describe(const World& world, std::size_t number, SummaryLines& sheet) {
    const Attachment& attachment = world.attachments[number];
    const bool is_seam = attachment.kind == AttachKind::Seam;
    std::size_t pairs = 0;
    double least = std::numeric_limits<double>::infinity();
    double greatest = 0.0;
    for (const AttachedPair& pair : world.attached_pairs) {
        if (static_cast<std::size_t>(pair.attachment) == number) {
            const double gap = pair_gap(pair, world.positions).norm();
            least = std::min(least, gap);
            greatest = std::max(greatest, gap);
            ++pairs;
        }
    }
    sheet.row("attach", "{}: {} of {} and {}, {}", attachment.name, is_seam ? "seam" : "button",
              cloth_name(world, attachment.cloth[0]), cloth_name(world, attachment.cloth[1]),
              plural(pairs, "pair"));
    if (is_seam) {
        sheet.row("", "sides {:.4g} and {:.4g} m long", attachment.length[0], attachment.length[1]);
    }
    sheet.row("", "gaps {:.4g} to {:.4g} m at the start; closes from {:.4g} to {:.4g} s{}", least,
              greatest, attachment.start, attachment.start + attachment.close,
              attachment.weld ? ", then welds" : "");
}

/// The report of one mesh of the scene, moved in under its object.
void add_mesh(const Scene& scene, const MeshSource& source, bool cloth, InspectReport& report) {
    const InspectReport mesh = describe_mesh_file(scene.base_dir / source.file, source, cloth);
    report.text += mesh.text;
    report.is_refused = report.is_refused || mesh.is_refused;
}

std::string describe_cloth(const ClothParams& cloth) {
    SummaryLines sheet;
    const std::string density = cloth.model == Model::Corotational
                                    ? fmt::format(", {:.4g} kg/m^2", cloth.fabric.area_density)
                                    : "";
    sheet.row("cloth", "{}: fabric {}{}, {}", cloth.name, cloth.fabric.name, density,
              plural(cloth.pins.size(), "pin"));
    if (cloth.model != Model::Corotational) {
        const SpringParams& spring = cloth.spring;
        const std::string soft = softening_text(cloth.model, spring);
        sheet.row("", "model {}, {:.4g} kg, {}{}", model_name(cloth.model), spring.mass,
                  spring.calibrate ? "K of its fabric" : fmt::format("K {:.4g} N/m", spring.K),
                  soft.empty() ? "" : ": " + soft);
    }
    if (cloth.mesh.file.empty()) {
        sheet.row("", "grid {:.4g} x {:.4g} m, {} x {} cells", cloth.grid_size.x(),
                  cloth.grid_size.y(), cloth.grid_cells[0], cloth.grid_cells[1]);
    }
    return sheet.text;
}

std::string describe_solid(const SolidParams& solid) {
    SummaryLines sheet;
    sheet.row("solid", "{}: spacing {:.4g} m, {:.4g} kg, {}", solid.name, solid.spacing,
              solid.spring.mass, plural(solid.pins.size(), "pin"));
    if (solid.mesh.file.empty()) {
        sheet.row("", "box {:.4g} x {:.4g} x {:.4g} m", solid.box.x(), solid.box.y(),
                  solid.box.z());
    }
    return sheet.text;
}

std::string describe_rigid(const RigidParams& rigid) {
    constexpr std::array<const char*, 4> names{"mesh", "sphere", "box", "plane"};
    SummaryLines sheet;
    sheet.row("rigid", "{}: {}, {:.4g} kg", rigid.name,
              names[static_cast<std::size_t>(rigid.shape)], rigid.mass);
    return sheet.text;
}

/// Places of the motion that are looked at for its extent.
constexpr int k_looks = 16;

std::string size_text(const Eigen::AlignedBox3d& box) {
    return fmt::format("from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) m", box.min().x(),
                       box.min().y(), box.min().z(), box.max().x(), box.max().y(), box.max().z());
}

/// How the shape of an obstacle changes during a scene, when it does: loads it as a run does.
///
/// Throws Error (BadInput) as import_obstacle() does.
void describe_deformation(const ObstacleParams& params,
                          const std::filesystem::path& base_dir,
                          const SceneParams& scene,
                          SummaryLines& sheet) {
    World world;
    const Obstacle& obstacle =
        add_obstacle(world, params, import_obstacle(params, base_dir, scene.fps, ignore_warning));
    if (!deforms(obstacle)) {
        return;
    }
    if (params.animation.is_sequence) {
        const std::size_t files = find_sequence(base_dir, params.mesh.file).files.size();
        sheet.row("sequence", "{}, {:.4g} a second", plural(files, "file"),
                  params.animation.fps > 0.0 ? params.animation.fps : scene.fps);
    }
    Eigen::AlignedBox3d box;
    const double end = (scene.frames - 1) / scene.fps;
    std::vector<Vec3> positions(obstacle.mesh.positions.size());
    for (int k = 0; k <= k_looks; ++k) {
        obstacle_positions(obstacle, end * k / k_looks, positions);
        for (const Vec3& x : positions) {
            box.extend(x);
        }
    }
    sheet.row("deforms", "over the scene {}", size_text(box));
}

/// A sequence is described by its first file.
void add_obstacle_mesh(const Scene& scene, const ObstacleParams& obstacle, InspectReport& report) {
    MeshSource source = obstacle.mesh;
    if (obstacle.animation.is_sequence) {
        source.file = find_sequence(scene.base_dir, source.file).names[0];
    }
    add_mesh(scene, source, false, report);
    if (!report.is_refused) {
        SummaryLines sheet;
        describe_deformation(obstacle, scene.base_dir, scene.scene, sheet);
        report.text += sheet.text;
    }
}

std::string describe_obstacle(const ObstacleParams& obstacle) {
    if (obstacle.shape == Shape::Mesh && obstacle.motion.empty()) {
        SummaryLines sheet; // whether its shape is animated is told below, from the file
        sheet.row("obstacle", "{}: mesh, no pose keys", obstacle.name);
        return sheet.text;
    }
    constexpr std::array<const char*, 4> names{"mesh", "sphere", "box", "plane"};
    SummaryLines sheet;
    sheet.row("obstacle", "{}: {}, {}", obstacle.name,
              names[static_cast<std::size_t>(obstacle.shape)],
              obstacle.motion.empty() ? "at rest" : plural(obstacle.motion.size(), "pose key"));
    return sheet.text;
}

/// What the attachments of a world at its start join: cloths, pairs, lengths, gaps; `warnings`
/// tell of sides that differ in length.
std::string describe_attachments(const World& world, const std::vector<std::string>& warnings) {
    SummaryLines sheet;
    for (std::size_t i = 0; i < world.attachments.size(); ++i) {
        if (!world.attachments[i].is_joint) {
            describe(world, i, sheet);
        }
    }
    for (const std::string& line : warnings) {
        if (line.starts_with("attach")) {
            sheet.row("warning", "{}", line);
        }
    }
    return sheet.text;
}

/// The pairs of triangles that cross at t = 0, by object and triangle number, with counts; refused
/// as a simulation would. Builds the scene's world: throws Error where that does.
InspectReport describe_start(const Scene& scene, const StartInspection& wanted) {
    InspectReport report;
    SummaryLines sheet;
    std::vector<std::string> warnings;
    const World world =
        build_world(scene, [&](const std::string& line) { warnings.push_back(line); });
    sheet.text = describe_solids(world) + describe_attachments(world, warnings);
    if (!scene.contact.enabled) {
        sheet.row("start", "contact is off: what crosses does not matter");
        return {sheet.text, false};
    }
    const auto pairs = WorldCrossings(world, scene.contact.self).find(world, world.time);
    if (pairs.empty()) {
        sheet.row("start", "nothing crosses");
    } else {
        Couples couples;
        for (const UnresolvedPair& pair : pairs) {
            couples[pair.objects].push_back(pair);
        }
        report.is_refused = scene.contact.start_overlap == StartOverlap::Error;
        sheet.row(report.is_refused ? "REFUSED" : "start", "{} of triangles cross: {}",
                  plural(pairs.size(), "pair"), what_is_done(scene.contact.start_overlap));
        list_pairs(world, couples, wanted.all_pairs, sheet);
    }
    if (!wanted.ply.empty()) {
        write_atomically(wanted.ply, std::string_view(encode_crossings(world, pairs)));
        sheet.row("written", "{}: the triangles that cross, and where", wanted.ply.string());
    }
    report.text = sheet.text;
    return report;
}

} // namespace

InspectReport describe_scene(const std::filesystem::path& file, const StartInspection& wanted) {
    SummaryLines sheet;
    sheet.text = file.string() + "\n";
    InspectReport report;
    try {
        const Scene scene = read_scene(file);
        const double seconds = static_cast<double>(scene.scene.frames - 1) / scene.scene.fps;
        sheet.row("scene", "{} at {:.4g} a second: {:.4g} s",
                  plural(static_cast<std::size_t>(scene.scene.frames), "frame"), scene.scene.fps,
                  seconds);
        report.text = sheet.text;
        for (const ClothParams& cloth : scene.cloths) {
            report.text += describe_cloth(cloth);
            if (!cloth.mesh.file.empty()) {
                add_mesh(scene, cloth.mesh, true, report);
            }
        }
        for (const SolidParams& solid : scene.solids) {
            report.text += describe_solid(solid);
            if (!solid.mesh.file.empty()) {
                add_mesh(scene, solid.mesh, true, report);
            }
        }
        for (const RigidParams& rigid : scene.rigids) {
            report.text += describe_rigid(rigid);
            if (rigid.shape == Shape::Mesh) {
                add_mesh(scene, rigid.mesh, true, report);
            }
        }
        for (const ObstacleParams& obstacle : scene.obstacles) {
            report.text += describe_obstacle(obstacle);
            if (obstacle.shape == Shape::Mesh) {
                add_obstacle_mesh(scene, obstacle, report);
            }
        }
        if (!report.is_refused) {
            const InspectReport start = describe_start(scene, wanted);
            report.text += start.text;
            report.is_refused = start.is_refused;
        }
    } catch (const Error& error) {
        if (error.code() != ExitCode::BadInput) {
            throw;
        }
        SummaryLines refusal;
        refusal.row("REFUSED", "{}", error.what());
        return {(report.text.empty() ? sheet.text : report.text) + refusal.text, true};
    }
    return report;
}

} // namespace weft
