#include "app/inspect_scene.h"

#include "app/inspect_animation.h"
#include "base/error.h"
#include "scene/law_shape.h"
#include "scene/mesh_sequence.h"
#include "scene/scene_reader.h"

namespace weft {

namespace {

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
