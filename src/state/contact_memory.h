#pragma once

#include "base/eigen.h"

#include <array>
#include <cstdint>

namespace weft {

/// What a pair in contact hands on to the next substep; or a legacy, see contact_legacy.h.
struct ContactMemory {
    std::array<Index, 4> pair; ///< vertices of the contact surface
    double rest;               ///< gap from which on nothing pushes, m
    Vec3 slip;                 ///< of its friction spring, m
    std::int64_t slides;       ///< 1 above the limit of friction, else 0; wide: no padding
};
static_assert(sizeof(ContactMemory) == 56, "is hashed and stored as bytes");

} // namespace weft
