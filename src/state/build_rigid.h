#pragma once

#include "state/world.h"

namespace weft {

/// Appends a rigid body to the world, behind all that is in it. Throws Error (BadInput) naming the
/// body and the place where its mesh is open, inside out or crosses itself.
void append_rigid(World& world,
                  const RigidParams& params,
                  const std::filesystem::path& base_dir,
                  const std::function<void(const std::string&)>& warn);

} // namespace weft
