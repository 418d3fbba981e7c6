#include "scene/scene_writer.h"

#include "scene/law_shape.h"
#include "scene/toml_writer.h"

#include <fmt/core.h>

namespace weft {
namespace {

void write_scene_params(TomlWriter& out, const SceneParams& params) {
    out.header("[scene]");
    out.line("frames", params.frames, "frame n is t = (n-1)/fps");
    out.line("fps", params.fps, "1/s");
    out.line("substeps", params.substeps, "a frame; 0 = automatic");
    out.line("integrator", params.integrator == Integrator::Euler ? "euler" : "bdf2");
    out.line("newton", params.newton, "iterations a substep");
    out.line("solver_tolerance", params.solver_tolerance, "relative residual");
    out.line("gravity", params.gravity, "m/s^2");
    out.line("wind", params.wind, "m/s");
    out.line("air_density", params.air_density, "kg/m^3");
}

void write_friction(TomlWriter& out, double friction, const std::optional<double>& at_rest) {
    out.line("friction", friction, "kinetic");
    if (at_rest) {
        out.line("static_friction", *at_rest);
    }
}

void write_contact(TomlWriter& out, const ContactParams& params) {
    out.header("[contact]");
    const char* const words[] = {"error", "grow", "untangle"};
    out.line("start_overlap", words[static_cast<int>(params.start_overlap)]);
    out.line("self", params.self);
    out.line("enabled", params.enabled);
    for (const FrictionPair& pair : params.friction) {
        out.header("[[contact.friction]]");
        out.line("between", pair.between);
        write_friction(out, pair.friction, pair.static_friction);
    }
}

/// The path of a mesh from `folder`, through links resolved on both sides.
std::string
relative_path(const Scene& scene, const std::filesystem::path& folder, const std::string& file) {
    return std::filesystem::proximate(scene.base_dir / file, folder).generic_string();
}

void write_mesh_source(TomlWriter& out,
                       const Scene& scene,
                       const std::filesystem::path& folder,
                       const MeshSource& source,
                       std::string_view key = "mesh") {
    out.line(key, relative_path(scene, folder, source.file));
    if (!source.objects.empty()) {
        out.line("object", source.objects);
    }
    if (source.units_given) {
        out.line("units", source.metres_per_unit, "m per unit of the file");
    }
    if (source.up_given) {
        out.line("up", std::string(1, source.up));
    }
    out.line("repair", source.repair);
}

void write_placement(TomlWriter& out, const Placement& placement) {
    out.line("translate", placement.translate, "m");
    out.line("rotate_deg", placement.rotate_deg, "about x, then y, then z");
    out.line("scale", placement.scale);
}

void write_fabric(TomlWriter& out, const FabricParams& fabric) {
    out.header("[cloth.fabric]");
    out.line("name", fabric.name);
    out.line("density", fabric.area_density, "kg/m^2");
    out.line("stretch", fabric.stretch_stiffness, "weft, warp, N/m");
    out.line("shear", fabric.shear_stiffness, "N/m");
    out.line("poisson", fabric.poisson);
    out.line("bend", fabric.bend_stiffness, "N m");
    out.line("thickness", fabric.thickness, "m");
    write_friction(out, fabric.friction, fabric.static_friction);
    out.line("damping", fabric.damping, "mass 1/s, stiffness s");
    out.line("range", fabric.working_range, "working range of stretch");
}

/// @param header  `[cloth.spring]` or `[solid.spring]`
void write_spring(TomlWriter& out,
                  std::string_view header,
                  Model model,
                  const SpringParams& spring) {
    if (model == Model::Corotational) {
        return;
    }
    const bool is_cloth = header == "[cloth.spring]";
    out.header(header);
    out.line("K", spring.K, "N/m at rest");
    out.line("K1", spring.K1, "N/m at a1");
    out.line("K2", spring.K2, "N/m at a2");
    out.line("a1", spring.a1);
    out.line("a2", spring.a2);
    if (is_cloth) {
        out.line("bend", spring.bend, "N/m");
    }
    out.line("shear", spring.shear, "diagonals over sides");
    out.line("damping", spring.damping, "N s/m");
    out.line("jacobian_damping", spring.jacobian_damping, "1: off");
    if (model != Model::StvkTriangle) {
        out.line("limit", spring.limit, "zeros: none");
    }
    out.line("mass", spring.mass, "kg");
    out.line("strict", spring.strict);
    if (is_cloth) {
        out.line("calibrate", spring.calibrate);
    }
}

void write_adapt(TomlWriter& out, const AdaptParams& adapt) {
    out.header("[cloth.adapt]");
    out.line("levels", adapt.levels, "0: the mesh stays as it is");
    out.line("curvature", adapt.curvature);
    out.line("contact", adapt.contact);
    out.line("compression", adapt.compression);
    out.line("velocity", adapt.velocity, "m/s");
    out.line("max_triangles", adapt.max_triangles);
}

void write_pin(TomlWriter& out, std::string_view header, const PinParams& pin) {
    out.header(header);
    if (!pin.vertices.empty()) {
        out.line("vertices", pin.vertices);
    }
    if (pin.has_box) {
        out.write("box",
                  fmt::format("{{ min = {}, max = {} }}", TomlWriter::toml_text(pin.box_min),
                              TomlWriter::toml_text(pin.box_max)),
                  "m");
    }
    if (pin.corners) {
        out.line("corners", true);
    }
    if (pin.loop >= 0) {
        out.line("loop", pin.loop);
    } else if (!pin.loop_side.empty()) {
        out.line("loop", pin.loop_side);
    }
    if (pin.until < k_forever) {
        out.line("until", pin.until, "s");
    }
    if (!pin.move.empty()) {
        out.line("move", pin.move, "t, x, y, z");
    }
    if (!pin.to.empty()) {
        out.line("to", pin.to);
    }
}

void write_cloth(TomlWriter& out,
                 const Scene& scene,
                 const std::filesystem::path& folder,
                 const ClothParams& cloth) {
    out.header("[[cloth]]");
    out.line("name", cloth.name);
    if (cloth.mesh.file.empty()) {
        out.write("grid",
                  fmt::format("{{ size = {}, cells = {} }}", TomlWriter::toml_text(cloth.grid_size),
                              TomlWriter::toml_text(cloth.grid_cells)));
    } else {
        write_mesh_source(out, scene, folder, cloth.mesh);
    }
    write_placement(out, cloth.placement);
    out.line("velocity", cloth.velocity, "m/s");
    out.line("model", model_name(cloth.model));
    out.line("bending", cloth.bend_model == BendModel::Quadratic ? "quadratic" : "mid_edge");
    out.line("rest", cloth.rest == RestShape::Mesh ? "mesh" : "uv");
    out.line("uv_scale", cloth.uv_scale, "m per unit of uv");
    out.line("grain_deg", cloth.grain_deg);
    out.line("pressure", cloth.pressure, "Pa");
    out.line("layer", cloth.layer);
    write_fabric(out, cloth.fabric);
    write_spring(out, "[cloth.spring]", cloth.model, cloth.spring);
    if (cloth.model == Model::Corotational) {
        write_adapt(out, cloth.adapt);
    }
    for (const PinParams& pin : cloth.pins) {
        write_pin(out, "[[cloth.pin]]", pin);
    }
}

void write_solid(TomlWriter& out,
                 const Scene& scene,
                 const std::filesystem::path& folder,
                 const SolidParams& solid) {
    out.header("[[solid]]");
    out.line("name", solid.name);
    if (solid.mesh.file.empty()) {
        out.line("box", solid.box, "m");
    } else {
        write_mesh_source(out, scene, folder, solid.mesh);
        out.line("fill", solid.fills_open ? "winding" : "closed");
    }
    out.line("spacing", solid.spacing, "m");
    write_placement(out, solid.placement);
    out.line("velocity", solid.velocity, "m/s");
    out.line("model", model_name(solid.model));
    out.line("thickness", solid.thickness, "m");
    write_friction(out, solid.friction, solid.static_friction);
    write_spring(out, "[solid.spring]", solid.model, solid.spring);
    for (const PinParams& pin : solid.pins) {
        write_pin(out, "[[solid.pin]]", pin);
    }
}

void write_animation(TomlWriter& out,
                     const Scene& scene,
                     const std::filesystem::path& folder,
                     const AnimationParams& animation) {
    if (!animation.name.empty()) {
        out.line("animation", animation.name);
    }
    if (!animation.cache.empty()) {
        out.line("cache", relative_path(scene, folder, animation.cache));
    }
    if (animation.fps > 0.0) {
        out.line("sequence_fps", animation.fps, "1/s");
    }
    out.line("animation_start", animation.start, "s");
    out.line("animation_speed", animation.speed);
    out.line("animation_end", animation.end == AnimationEnd::Hold ? "hold" : "loop");
}

void write_obstacle(TomlWriter& out,
                    const Scene& scene,
                    const std::filesystem::path& folder,
                    const ObstacleParams& obstacle) {
    out.header("[[obstacle]]");
    out.line("name", obstacle.name);
    switch (obstacle.shape) {
    case Shape::Mesh:
        write_mesh_source(out, scene, folder, obstacle.mesh,
                          obstacle.animation.is_sequence ? "sequence" : "mesh");
        write_animation(out, scene, folder, obstacle.animation);
        break;
    case Shape::Sphere:
        out.line("shape", "sphere");
        out.line("radius", obstacle.radius, "m");
        break;
    case Shape::Box:
    case Shape::Plane:
        out.line("shape", obstacle.shape == Shape::Box ? "box" : "plane");
        out.line("size", obstacle.size, "m");
        break;
    }
    write_placement(out, obstacle.placement);
    write_friction(out, obstacle.friction, obstacle.static_friction);
    std::string motion;
    for (const PoseKey& key : obstacle.motion) {
        motion += fmt::format("    {{ t = {}, translate = {}, rotate_deg = {} }},\n",
                              TomlWriter::toml_text(key.t), TomlWriter::toml_text(key.translate),
                              TomlWriter::toml_text(key.rotate_deg));
    }
    if (!motion.empty()) {
        out.write("motion", "[\n" + motion + "]");
    }
}

void write_rigid(TomlWriter& out,
                 const Scene& scene,
                 const std::filesystem::path& folder,
                 const RigidParams& rigid) {
    out.header("[[rigid]]");
    out.line("name", rigid.name);
    if (rigid.shape == Shape::Mesh) {
        write_mesh_source(out, scene, folder, rigid.mesh);
    } else if (rigid.shape == Shape::Sphere) {
        out.line("shape", "sphere");
        out.line("radius", rigid.radius, "m");
    } else {
        out.line("shape", "box");
        out.line("size", rigid.size, "m");
    }
    out.line("mass", rigid.mass, "kg");
    write_placement(out, rigid.placement);
    out.line("velocity", rigid.velocity, "m/s");
    out.line("spin_deg", rigid.spin_deg, "degrees/s");
    out.line("thickness", rigid.thickness, "m");
    write_friction(out, rigid.friction, rigid.static_friction);
}

std::string vertex_text(const VertexChoice& choice) {
    return choice.vertex == k_no_index ? TomlWriter::toml_text(choice.place)
                                       : TomlWriter::toml_text(choice.vertex);
}

void write_side(TomlWriter& out, std::string_view key, const AttachSide& side) {
    std::string text = "{ cloth = " + TomlWriter::toml_text(side.cloth);
    if (!side.vertices.empty()) {
        text += ", vertices = " + TomlWriter::toml_text(side.vertices);
    }
    if (side.from) {
        text += ", from = " + vertex_text(*side.from);
    }
    if (side.to) {
        text += ", to = " + vertex_text(*side.to);
    }
    if (side.via) {
        text += ", via = " + vertex_text(*side.via);
    }
    if (side.at) {
        text += ", at = " + TomlWriter::toml_text(*side.at);
    }
    out.write(key, text + " }");
}

void write_attach(TomlWriter& out, const AttachParams& attach) {
    const bool is_seam = attach.kind == AttachKind::Seam;
    out.header("[[attach]]");
    out.line("name", attach.name);
    out.line("kind", is_seam ? "seam" : "button");
    write_side(out, "a", attach.a);
    write_side(out, "b", attach.b);
    out.line("start", attach.start, "s");
    out.line("close", attach.close, "s");
    if (attach.until < k_forever) {
        out.line("until", attach.until, "s");
    }
    out.line("strength", attach.strength, is_seam ? "N/m" : "N");
    out.line("radius", attach.radius, "m");
    out.line("weld", attach.weld);
}

void write_render(TomlWriter& out, const RenderParams& render) {
    out.header("[render]");
    out.line("size", render.size, "pixels");
    out.line("quantity", render.quantity);
    out.line("map", render.map);
    if (render.has_range) {
        out.line("range", render.range);
    }
    out.line("edges", render.edges);
    out.line("legend", render.legend);
    out.line("problems", render.problems);
    if (render.has_camera) {
        out.write("camera", fmt::format("{{ eye = {}, target = {}, fov_deg = {} }}",
                                        TomlWriter::toml_text(render.camera.eye),
                                        TomlWriter::toml_text(render.camera.target),
                                        TomlWriter::toml_text(render.camera.fov_deg)));
    }
    out.line("supersample", render.supersample, "per axis");
    out.line("enabled", render.enabled);
}

} // namespace

std::string write_scene(const Scene& scene, const std::filesystem::path& folder) {
    TomlWriter out;
    write_scene_params(out, scene.scene);
    write_contact(out, scene.contact);
    for (const ClothParams& cloth : scene.cloths) {
        write_cloth(out, scene, folder, cloth);
    }
    for (const SolidParams& solid : scene.solids) {
        write_solid(out, scene, folder, solid);
    }
    for (const RigidParams& rigid : scene.rigids) {
        write_rigid(out, scene, folder, rigid);
    }
    for (const ObstacleParams& obstacle : scene.obstacles) {
        write_obstacle(out, scene, folder, obstacle);
    }
    for (const AttachParams& attach : scene.attachments) {
        write_attach(out, attach);
    }
    write_render(out, scene.render);
    return out.text();
}

} // namespace weft
