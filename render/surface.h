#pragma once

#include "base/eigen.h"
#include "frames/frame.h"

#include <span>
#include <vector>

namespace weft {

/// Ambient light that a vertex receives on each side, as fractions of an unhindered hemisphere:
/// from above (sky) and from below (floor).
struct Ambient {
    float front_sky = 0.5F, front_floor = 0.5F;
    float back_sky = 0.5F, back_floor = 0.5F;
};

/// Several objects of one kind as one list of vertices and triangles, ready to be drawn.
struct Surface {
    std::vector<Vec3f> positions; ///< m
    std::vector<Vec3f> normals;   ///< unit, on the side from which triangles turn left
    std::vector<float> values;    ///< the shown quantity; zero where there is none
    std::vector<Ambient> ambient; ///< full light until add_ambient_occlusion()
    std::vector<Triangle> triangles;
};

/// Adds an object with smooth normals: the area-weighted mean over each vertex's triangles.
/// `values` is #V or empty.
void append_smooth(Surface& surface, const FrameObject& object, std::span<const float> values);

inline constexpr float k_crease_cosine = 0.766F; ///< cosine of 40 degrees
inline constexpr float k_solid_crease_cosine =
    0.423F; ///< cosine of 65 degrees: soft things are round

/// Adds an object whose edges stay sharp where neighbouring triangles turn by more than an angle:
/// such a vertex is repeated, once for each group of triangles that are smooth together. `values`
/// is #V or empty.
void append_creased(Surface& surface,
                    const FrameObject& object,
                    std::span<const float> values = {},
                    float crease_cosine = k_crease_cosine);

} // namespace weft
