#include "support/worlds.h"

#include "state/build_world.h"

#include <stdexcept>

namespace weft::test {

ClothParams record_sheet(int cells) {
    ClothParams sheet;
    sheet.name = "sheet";
    sheet.grid_cells = {cells, cells};
    sheet.fabric.area_density = 0.2;
    sheet.fabric.stretch_stiffness = {2000.0, 2000.0};
    sheet.fabric.shear_stiffness = 800.0;
    sheet.fabric.poisson = 0.25;
    sheet.fabric.bend_stiffness = 1e-5;
    return sheet;
}

Scene scene_of(const ClothParams& cloth) {
    Scene scene;
    scene.cloths.push_back(cloth);
    return scene;
}

World build_quietly(const Scene& scene) {
    return build_world(scene, [](const std::string& line) { throw std::runtime_error(line); });
}

} // namespace weft::test
