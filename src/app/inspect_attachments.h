#pragma once

#include "state/world.h"

namespace weft {

/// What the attachments of a world at its start join: cloths, pairs, lengths, gaps. With `warnings`
/// of their sides' lengths.
std::string describe_attachments(const World& world, const std::vector<std::string>& warnings);

} // namespace weft
