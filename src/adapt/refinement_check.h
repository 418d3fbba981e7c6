#pragma once

#include "state/cloth.h"

#include <string>

namespace weft {

/// What is wrong with an adaptive cloth, or "": sizes, edges against build_edges, Euler number,
/// generations across edges and at vertices, flips that wait, rest areas and lengths. Slow: looks
/// at everything. For asserts of debug builds and for tests.
std::string check_refinement(const Cloth& cloth);

} // namespace weft
