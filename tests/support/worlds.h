#pragma once

#include "state/build_world.h"

namespace weft::test {

/// The sheet of the speed records: 1 m square, stretch 2000 N/m, shear 800 N/m, 0.2 kg/m^2,
/// bend 1e-5 N m, lying in x-z at height 0.
ClothParams record_sheet(int cells);

/// A scene with one cloth and nothing else, at default settings.
Scene scene_of(const ClothParams& cloth);

/// build_world of a scene that must give no warning.
World build_quietly(const Scene& scene);

} // namespace weft::test
