#pragma once

#include "state/build_world.h"
#include "state/world.h"

namespace weft::test {

/// A scene of one grid in the x-z plane, `size` m a side, `cells` squares a side.
inline Scene grid_scene(double size, int cells) {
    Scene scene;
    ClothParams cloth;
    cloth.name = "sheet";
    cloth.grid_size = Vec2(size, size);
    cloth.grid_cells = {cells, cells};
    scene.cloths.push_back(cloth);
    return scene;
}

inline World grid_world(double size, int cells) {
    return build_world(grid_scene(size, cells), [](const std::string&) {});
}

} // namespace weft::test
