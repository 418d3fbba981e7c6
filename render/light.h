#pragma once

#include "render/camera.h"

namespace weft {

/// The sun-like key light of the studio and the box that its shadow map covers.
struct KeyLight {
    Vec3 direction;       ///< towards the light, unit
    Vec3 counter;         ///< towards a weak light from the other side, unit
    Vec3 right, up;       ///< axes of the shadow map, unit
    double extent = 1.0;  ///< m, a side of the map
    double depth = 1.0;   ///< m, what light depth 0..1 spans
    double kernel = 0.01; ///< radius of the penumbra in units of the map
    Mat4f to_clip;        ///< world to the clip space of the shadow map
    Mat4f to_map;         ///< world to [0, 1]^3: texture place and depth
};

/// A key light from above the camera's left shoulder, fitted to the box.
KeyLight place_key_light(const Camera& camera, const Box3& subject);

} // namespace weft
