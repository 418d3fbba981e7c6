#pragma once

#include <string>

/// The GLSL programs (330, without the #version line). Light is linear until `resolve`.
namespace weft::shaders {

std::string depth_vertex(); ///< positions to the clip space of a matrix
std::string depth_fragment();

std::string surface_vertex();
std::string cloth_fragment(); ///< value to colour, light, mesh lines
std::string clay_fragment();
std::string floor_fragment(); ///< black, with the light that the floor lacks as alpha

std::string value_fragment(); ///< the bare value, for counting

std::string screen_vertex();    ///< one triangle over the whole picture
std::string resolve_fragment(); ///< samples to pixels, backdrop behind, sRGB, dither

} // namespace weft::shaders
