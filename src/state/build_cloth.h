#pragma once

#include "state/world.h"

namespace weft {

/// Loads or makes the mesh of a `[[cloth]]`, builds its rest shape and masses, and appends it to
/// the world, at rest where its placement puts it, with its start velocity.
void append_cloth(World& world,
                  const ClothParams& params,
                  const std::filesystem::path& base_dir,
                  const std::function<void(const std::string&)>& warn);

} // namespace weft
