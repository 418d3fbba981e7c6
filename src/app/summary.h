#pragma once

#include "state/world.h"

#include <string>

namespace weft {

/// What a run would compute, a line an object and a line for the whole, for people.
std::string summarise(const Scene& scene, const World& world);

} // namespace weft
