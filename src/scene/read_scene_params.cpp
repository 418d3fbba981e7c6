#include "scene/read_parts.h"

namespace weft {

SceneParams read_scene_params(TomlTable table) {
    SceneParams params;
    table.read("frames", params.frames);
    table.read("fps", params.fps);
    table.read("substeps", params.substeps);
    table.read_choice("integrator", params.integrator,
                      {{"euler", Integrator::Euler}, {"bdf2", Integrator::Bdf2}});
    table.read("newton", params.newton);
    table.read("solver_tolerance", params.solver_tolerance);
    table.read("gravity", params.gravity);
    table.read("wind", params.wind);
    table.read("air_density", params.air_density);
    table.finish();
    table.refuse(problem(params));
    return params;
}

} // namespace weft
