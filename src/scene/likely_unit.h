#pragma once

#include <string>

namespace weft {

/// A warning when the largest dimension of an object lies outside 1 cm to 10 m, naming the units
/// that would make it as large as clothes and people are; "" otherwise.
///
/// @param size             largest dimension, m
/// @param metres_per_unit  what was used to get there
std::string size_warning(double size, double metres_per_unit);

} // namespace weft
