#include "scene/params.h"

#include "scene/names.h"

#include <fmt/core.h>

#include <cmath>
#include <span>

namespace weft {
namespace {

/// The first thing that is wrong, as problem() returns it.
class Finding {
public:
    template <typename T>
    void require(bool holds, std::string_view key, const T& value, std::string_view allowed) {
        if (!holds && text_.empty()) {
            text_ = fmt::format("{} = {}: must be {}", key, value, allowed);
        }
    }
    void positive(std::string_view key, double value, std::string_view unit) {
        require(value > 0.0 && std::isfinite(value), key, value, with_unit("> 0", unit));
    }
    void not_negative(std::string_view key, double value, std::string_view unit) {
        require(value >= 0.0 && std::isfinite(value), key, value, with_unit(">= 0", unit));
    }
    void refuse(std::string text) {
        if (text_.empty()) {
            text_ = std::move(text);
        }
    }
    const std::string& text() const { return text_; }

private:
    static std::string with_unit(std::string_view bound, std::string_view unit) {
        return unit.empty() ? std::string(bound) : fmt::format("{} {}", bound, unit);
    }

    std::string text_;
};

void check_friction(Finding& finding, double friction, const std::optional<double>& at_rest) {
    finding.not_negative("friction", friction, "");
    if (at_rest) {
        finding.require(*at_rest >= friction && std::isfinite(*at_rest), "static_friction",
                        *at_rest, fmt::format(">= friction, {}", friction));
    }
}

std::string element(std::string_view key, Eigen::Index i) {
    return fmt::format("{}[{}]", key, i);
}

void require_ascending(Finding& finding, std::string_view key, double earlier, double later) {
    finding.require(later > earlier, key, later, fmt::format("> {} s, the time before", earlier));
}

} // namespace

std::string problem(const SceneParams& params) {
    Finding finding;
    finding.require(params.frames >= 1 && params.frames <= 1'000'000, "frames", params.frames,
                    "1 to 1000000");
    finding.positive("fps", params.fps, "1/s");
    finding.require(params.substeps >= 0 && params.substeps <= 100'000, "substeps", params.substeps,
                    "0 (automatic) to 100000");
    finding.require(params.newton >= 1 && params.newton <= 100, "newton", params.newton,
                    "1 to 100");
    finding.require(params.solver_tolerance > 0.0 && params.solver_tolerance <= 0.1,
                    "solver_tolerance", params.solver_tolerance, "> 0 and <= 0.1");
    finding.not_negative("air_density", params.air_density, "kg/m^3");
    return finding.text();
}

std::string problem(const Placement& params) {
    Finding finding;
    finding.positive("scale", params.scale, "");
    return finding.text();
}

std::string problem(const MeshSource& params) {
    Finding finding;
    finding.positive("units", params.metres_per_unit, "m, or \"m\", \"cm\", \"mm\" or \"in\"");
    finding.require(params.up == 'y' || params.up == 'z', "up", params.up, "\"y\" or \"z\"");
    return finding.text();
}

std::string problem(const FrictionPair& params) {
    Finding finding;
    check_friction(finding, params.friction, params.static_friction);
    return finding.text();
}

std::string problem(const FabricParams& params) {
    Finding finding;
    finding.positive("density", params.area_density, "kg/m^2");
    for (Eigen::Index i = 0; i < 2; ++i) {
        finding.positive(element("stretch", i), params.stretch_stiffness[i], "N/m");
    }
    finding.positive("shear", params.shear_stiffness, "N/m");
    finding.require(params.poisson >= 0.0 && params.poisson < 1.0, "poisson", params.poisson,
                    ">= 0 and < 1");
    finding.not_negative("bend", params.bend_stiffness, "N m");
    finding.positive("thickness", params.thickness, "m");
    check_friction(finding, params.friction, params.static_friction);
    finding.not_negative("damping[0]", params.damping[0], "1/s");
    finding.not_negative("damping[1]", params.damping[1], "s");
    finding.positive("range[0]", params.working_range[0], "");
    finding.require(params.working_range[1] > params.working_range[0], "range[1]",
                    params.working_range[1],
                    fmt::format("> range[0], {}", params.working_range[0]));
    return finding.text();
}

std::string problem(const PinParams& params) {
    Finding finding;
    for (std::size_t i = 0; i < params.vertices.size(); ++i) {
        finding.require(params.vertices[i] >= 0, element("vertices", static_cast<Eigen::Index>(i)),
                        params.vertices[i], ">= 0, the index of a vertex");
    }
    for (Eigen::Index i = 0; i < 3 && params.has_box; ++i) {
        finding.require(params.box_min[i] <= params.box_max[i], element("box.min", i),
                        params.box_min[i],
                        fmt::format("<= box.max[{}], {} m", i, params.box_max[i]));
    }
    finding.require(params.loop >= -1, "loop", params.loop,
                    ">= 0 (0: the longest boundary loop), \"top\" or \"bottom\"");
    finding.require(params.until >= 0.0, "until", params.until, ">= 0 s");
    for (std::size_t i = 1; i < params.move.size(); ++i) {
        require_ascending(finding, fmt::format("move[{}][0]", i), params.move[i - 1][0],
                          params.move[i][0]);
    }
    return finding.text();
}

std::string problem(const AdaptParams& params) {
    Finding finding;
    finding.require(params.levels >= 0 && params.levels <= 8, "levels", params.levels, "0 to 8");
    finding.not_negative("curvature", params.curvature, "");
    finding.require(params.compression >= 0.0 && params.compression < 1.0, "compression",
                    params.compression, "0 to below 1");
    finding.not_negative("velocity", params.velocity, "m/s");
    finding.require(params.max_triangles >= 1, "max_triangles", params.max_triangles, ">= 1");
    return finding.text();
}

std::string problem(const SpringParams& params) {
    Finding finding;
    finding.positive("K", params.K, "N/m");
    finding.positive("K1", params.K1, "N/m");
    finding.positive("K2", params.K2, "N/m");
    finding.require(params.a1 > 1.0, "a1", params.a1, "> 1, a stretch");
    finding.require(params.a2 > 0.0 && params.a2 < 1.0, "a2", params.a2, "> 0 and < 1, a stretch");
    finding.not_negative("bend", params.bend, "N/m");
    finding.not_negative("shear", params.shear, "");
    finding.not_negative("damping", params.damping, "N s/m");
    finding.require(params.jacobian_damping > 0.0 && params.jacobian_damping <= 1.0,
                    "jacobian_damping", params.jacobian_damping, "> 0 and <= 1");
    const bool is_limited = params.limit != Vec2(0.0, 0.0);
    finding.require(!is_limited || (params.limit[0] >= 0.0 && params.limit[0] < 1.0), "limit[0]",
                    params.limit[0], ">= 0 and < 1, the least stretch");
    finding.require(!is_limited || params.limit[1] > 1.0, "limit[1]", params.limit[1],
                    "> 1, the greatest stretch");
    finding.positive("mass", params.mass, "kg");
    return finding.text();
}

std::string problem(const ClothParams& params) {
    Finding finding;
    for (Eigen::Index i = 0; i < 2; ++i) {
        const int cells = params.grid_cells[static_cast<std::size_t>(i)];
        finding.positive(element("grid.size", i), params.grid_size[i], "m");
        finding.require(cells >= 1 && cells <= 4096, element("grid.cells", i), cells, "1 to 4096");
    }
    finding.positive("uv_scale", params.uv_scale, "m per unit of uv");
    return finding.text();
}

std::string problem(const SolidParams& params) {
    Finding finding;
    for (Eigen::Index i = 0; i < 3 && params.mesh.file.empty(); ++i) {
        finding.positive(element("box", i), params.box[i], "m");
    }
    finding.positive("spacing", params.spacing, "m");
    for (Eigen::Index i = 0; i < 3 && params.mesh.file.empty() && finding.text().empty(); ++i) {
        const double scale = params.placement.scale;
        const double cells = params.box[i] * scale / params.spacing;
        const double nearest = std::max(1.0, std::round(cells));
        finding.require(std::abs(cells - nearest) <= 1e-6, element("box", i), params.box[i],
                        fmt::format("a whole number of spacings; the nearest is {:.9g} m",
                                    nearest * params.spacing / scale));
    }
    finding.positive("thickness", params.thickness, "m");
    check_friction(finding, params.friction, params.static_friction);
    return finding.text();
}

std::string problem(const RigidParams& params) {
    Finding finding;
    finding.positive("radius", params.radius, "m");
    for (Eigen::Index i = 0; i < 3; ++i) {
        finding.positive(element("size", i), params.size[i], "m");
    }
    finding.positive("mass", params.mass, "kg");
    finding.positive("thickness", params.thickness, "m");
    check_friction(finding, params.friction, params.static_friction);
    return finding.text();
}

std::string problem(const AnimationParams& params) {
    Finding finding;
    finding.require(params.fps >= 0.0 && params.fps <= 1e6, "sequence_fps", params.fps,
                    "> 0 and <= 1000000, 1/s");
    finding.require(params.speed > 0.0 && params.speed <= 1e6, "animation_speed", params.speed,
                    "> 0 and <= 1000000");
    finding.require(std::isfinite(params.start), "animation_start", params.start, "a time, s");
    return finding.text();
}

std::string problem(const ObstacleParams& params) {
    Finding finding;
    finding.positive("radius", params.radius, "m");
    for (Eigen::Index i = 0; i < 3; ++i) {
        finding.positive(element("size", i), params.size[i], "m");
    }
    check_friction(finding, params.friction, params.static_friction);
    for (std::size_t i = 1; i < params.motion.size(); ++i) {
        require_ascending(finding, fmt::format("motion[{}].t", i), params.motion[i - 1].t,
                          params.motion[i].t);
    }
    return finding.text();
}

std::string problem(const AttachParams& params) {
    Finding finding;
    finding.not_negative("start", params.start, "s");
    finding.not_negative("close", params.close, "s");
    finding.require(params.until > params.start, "until", params.until,
                    fmt::format("> start, {} s", params.start));
    finding.positive("strength", params.strength,
                     params.kind == AttachKind::Seam ? "N/m of seam" : "N");
    finding.positive("radius", params.radius, "m");
    return finding.text();
}

std::string problem(const RenderParams& params) {
    Finding finding;
    for (std::size_t i = 0; i < 2; ++i) {
        finding.require(params.size[i] >= 16 && params.size[i] <= 8192,
                        element("size", static_cast<Eigen::Index>(i)), params.size[i],
                        "16 to 8192 pixels");
    }
    finding.require(is_one_of(k_quantity_names, params.quantity), "quantity", params.quantity,
                    "a quantity that can be drawn");
    finding.require(is_one_of(k_map_names, params.map), "map", params.map,
                    "the name of a colour map");
    finding.require(params.range[1] > params.range[0], "range[1]", params.range[1],
                    fmt::format("> range[0], {}", params.range[0]));
    finding.require(params.camera.fov_deg > 0.0 && params.camera.fov_deg < 170.0, "camera.fov_deg",
                    params.camera.fov_deg, "> 0 and < 170 degrees");
    const bool looks_somewhere = (params.camera.eye - params.camera.target).norm() > 0.0;
    if (!looks_somewhere) {
        finding.refuse("camera.target: must differ from camera.eye");
    }
    finding.require(params.supersample >= 1 && params.supersample <= 4, "supersample",
                    params.supersample, "1 to 4");
    return finding.text();
}

} // namespace weft
