#pragma once

#include "render/gl.h"

#include <vector>

namespace weft {

/// Framebuffers of one picture size. Made once, drawn into for each frame; the context must be
/// current for every call.
class Targets {
public:
    Targets(const Gl& gl, int width, int height, int supersample, int shadow_size);
    void release(const Gl& gl);

    /// Samples of light: 4 a pixel, supersample^2 pixels a final pixel; RGB premultiplied, and how
    /// much of the backdrop is hidden as alpha.
    GLuint samples = 0, samples_texture = 0, samples_depth = 0;
    /// Depth seen from the light.
    GLuint shadow = 0, shadow_texture = 0;
    /// The picture, 8 bits a channel.
    GLuint picture = 0, picture_colour = 0;
    /// Value and cloth flag of each final pixel.
    GLuint values = 0, values_colour = 0, values_depth = 0;
};

} // namespace weft
