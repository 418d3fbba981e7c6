#include "scene/scene_keys.h"

#include "scene/names.h"

#include <fmt/core.h>

namespace weft {
namespace {

template <std::size_t N>
Words word_of(std::string& value, const std::array<std::string_view, N>& names) {
    std::vector<std::pair<std::string, std::string>> choices;
    for (const std::string_view name : names) {
        choices.emplace_back(name, name);
    }
    return one_of(value, std::move(choices));
}

Keys keys_of(CameraParams& p) {
    return {
        {"eye", &p.eye, "m", "", "where the camera stands", "", "required"},
        {"target", &p.target, "m", "", "where it looks", "", "required"},
        {"fov_deg", &p.fov_deg, "degrees", "> 0 and < 170", "vertical angle of view"},
    };
}

/// "what the colour shows: stretch (principal stretch), ..., speed (speed, m/s)"
std::string quantities_meaning() {
    std::string text;
    for (const Quantity& q : k_quantities) {
        const bool is_ratio = q.unit == "1";
        text += fmt::format("{}{} ({}{}{})", text.empty() ? "what the colour shows: " : ", ",
                            q.name, q.title, is_ratio ? "" : ", ", is_ratio ? "" : q.unit);
    }
    return text;
}

} // namespace

Keys keys_of(SceneParams& p) {
    return {
        {"frames", &p.frames, "", "1 to 1000000",
         "frames written; frame 1 is t = 0, frame n is t = (n-1)/fps", "frame n is t = (n-1)/fps"},
        {"fps", &p.fps, "1/s", "> 0", "frames a second"},
        {"substeps", &p.substeps, "", "0 (automatic) to 100000", "steps a frame; 0 = automatic",
         "a frame; 0 = automatic"},
        {"integrator",
         one_of(p.integrator, {{"euler", Integrator::Euler}, {"bdf2", Integrator::Bdf2}}), "", "",
         "\"euler\": implicit; \"bdf2\": less damping, no rigid bodies"},
        {"newton", &p.newton, "", "1 to 100", "iterations a substep; 1 = one linearisation",
         "iterations a substep"},
        {"solver_tolerance", &p.solver_tolerance, "", "> 0 and <= 0.1",
         "residual of the linear solve relative to its right-hand side; larger: softer, noisier "
         "cloth",
         "relative residual"},
        {"gravity", &p.gravity, "m/s^2", "", "acceleration of free fall"},
        {"wind", &p.wind, "m/s", "", "velocity of the air"},
        {"air_density", &p.air_density, "kg/m^3", ">= 0", "density of the air; 0 = no air"},
    };
}

Keys keys_of(ContactParams& p) {
    return {
        {"start_overlap",
         one_of(p.start_overlap, {{"error", StartOverlap::Error},
                                  {"grow", StartOverlap::Grow},
                                  {"untangle", StartOverlap::Untangle}}),
         "", "",
         "cloth that crosses something at the start is refused (\"error\"), or parted before the "
         "first frame: \"untangle\" moves cloth by geometry, \"grow\" draws obstacles in and lets "
         "them grow back into the cloth over a simulated pre-roll; `weft inspect SCENE.toml` lists "
         "what crosses"},
        {"self", &p.self, "", "", "cloth touches itself and other cloth"},
        {"enabled", &p.enabled, "", "", "false: nothing touches anything"},
        {"friction", Elsewhere{}, "", "", "`[[contact.friction]]`", "", "mixed from the objects'"},
    };
}

Keys friction_keys(double& friction, std::optional<double>& at_rest) {
    return {
        {"friction", &friction, "", ">= 0",
         "Coulomb coefficient of what slides; two objects share the square root of their product",
         "kinetic"},
        {"static_friction", &at_rest, "",
         at_least(friction, fmt::format(">= friction, {}", friction)),
         "Coulomb coefficient of what rests", "", "`friction`"},
    };
}

Keys keys_of(FrictionPair& p) {
    return {
        {"between", &p.between, "", "",
         "`[\"shirt\", \"body\"]`: the names of two objects; the same name twice: the object with "
         "itself",
         "", "required"},
        {"friction", &p.friction, "", ">= 0", "Coulomb coefficient of what slides", "kinetic",
         "required"},
        friction_keys(p.friction, p.static_friction).back(),
    };
}

Keys keys_of(RenderParams& p) {
    const Range above_first = more_than(p.range[0], fmt::format("> range[0], {}", p.range[0]));
    return {
        {"size", &p.size, "pixels", "16 to 8192", "width and height of a picture"},
        {"quantity", word_of(p.quantity, k_quantity_names), "", "", quantities_meaning()},
        {"map", word_of(p.map, k_map_names), "", "", "the colour map; \"seed\" is green to red"},
        Key{"range", &p.range, "", std::vector{any_number(), above_first},
            "ends of the colour scale in the quantity's unit, fixed over the run; values outside "
            "have their own colours",
            "", "the fabrics' range"}
            .written_if(p.has_range),
        {"edges", &p.edges, "", "", "mesh lines"},
        {"legend", &p.legend, "", "", "the colour scale in the picture"},
        {"problems", &p.problems, "", "",
         "a ring around each unresolved pair, in front of everything, and their number in the "
         "legend"},
        Key{"camera", Inline{keys_of(p.camera)}, "", "", "a camera that stands still", "",
            "frames the motion"}
            .written_if(p.has_camera),
        {"supersample", &p.supersample, "", "1 to 4",
         "samples along a pixel's side, on top of 4 samples a pixel", "per axis"},
        {"enabled", &p.enabled, "", "", "false: no pictures"},
    };
}

Keys keys_of(AttachParams& p) {
    const bool is_seam = p.kind == AttachKind::Seam;
    return {
        {"name", &p.name, "", "", "unique among attachments", "", "required"},
        {"kind", one_of(p.kind, {{"seam", AttachKind::Seam}, {"button", AttachKind::Button}}), "",
         "",
         "\"seam\": two borders become one line; \"button\": points held one contact thickness "
         "apart",
         "", "required"},
        Key{"a", Inline{keys_of(p.a, p.kind)}, "", "", "the first side", "", "required"}.read_if(
            false),
        Key{"b", Inline{keys_of(p.b, p.kind)}, "", "", "the second side", "", "required"}.read_if(
            false),
        {"start", &p.start, "s", ">= 0", "when it begins to pull"},
        {"close", &p.close, "s", ">= 0",
         "how long its length takes to fall smoothly from what it is at the start to nothing"},
        {"until", &p.until, "s", more_than(p.start, fmt::format("> start, {} s", p.start)),
         "when it lets go", "", "for ever"},
        {"strength", &p.strength, is_seam ? "N/m" : "N", is_seam ? "> 0 N/m of seam" : "> 0",
         "the most it pulls while it closes: N per m of seam, N per button"},
        {"radius", &p.radius, "m", "> 0", "how far a place may be from what it stands for"},
        {"weld", &p.weld, "", "",
         "once closed (within half a thickness) held for good, with no limit; false: pulled by "
         "`strength` at most"},
    };
}

Keys keys_of(AttachSide& p, AttachKind kind) {
    const bool is_seam = kind == AttachKind::Seam;
    return {
        {"cloth", &p.cloth, "", "", "the name of the cloth", "", "required"},
        {"vertices", &p.vertices, "", "",
         "a list; of a seam in order, matched by the fraction of its length", "", "none"},
        Key{"from", &p.from, "", "",
            "of a seam: along the border from here to `to`, the shorter way. A vertex or a place "
            "`[x, y, z]` (m, in the world at t = 0). `from` of `a` meets `from` of `b`",
            "", "none"}
            .read_if(is_seam),
        Key{"to", &p.to, "", "", "of a seam: the other end of the border", "", "none"}.read_if(
            is_seam),
        Key{"via", &p.via, "", "",
            "of a seam: a vertex or place on the way, where the longer way is meant", "", "none"}
            .read_if(is_seam),
        Key{"at", &p.at, "m", "",
            "of a button: the nearest point to this place. `b` may say its cloth alone: the "
            "nearest point to `a`",
            "", "none"}
            .read_if(!is_seam),
    };
}

std::string problem(RenderParams params) {
    const std::string found = problem_of(keys_of(params));
    const bool looks_somewhere = (params.camera.eye - params.camera.target).norm() > 0.0;
    return found.empty() && !looks_somewhere ? "camera.target: must differ from camera.eye" : found;
}

} // namespace weft
