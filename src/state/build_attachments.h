#pragma once

#include "state/world.h"

#include <functional>
#include <string>

namespace weft {

/// Fills world.attachments, attached_pairs and attached_states from the scene's `[[attach]]`, given
/// cloths at t = 0. `warn` gets a line where the sides of a seam differ in length. Throws Error
/// (BadInput) naming attachment and key.
void build_attachments(World& world,
                       std::span<const AttachParams> params,
                       const std::function<void(const std::string&)>& warn);

} // namespace weft
