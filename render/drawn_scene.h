#pragma once

#include "render/camera.h"
#include "render/image.h"
#include "render/surface.h"

namespace weft {

/// A frame as the renderer draws it: cloth and solids in colours, the rest as clay, and the floor
/// below them.
struct DrawnScene {
    Box3 subject;  ///< the box that shadow and ambient occlusion cover
    Surface cloth; ///< values of the shown quantity
    Surface clay;  ///< obstacles, rigid bodies, and solids that have no such quantity
    Surface floor; ///< a disc that only shows shadow; empty when the camera is below it
    Vec3f floor_centre = Vec3f::Zero();
    float floor_radius = 1.0F;
};

/// Builds it from a frame. The floor lies under `bounds`, or where a level slab among the obstacles
/// dwarfs the subject, on top of that slab, which is then not drawn itself.
DrawnScene build_drawn_scene(const Frame& frame, int quantity, const Box3& bounds, const Vec3& eye);

/// Draws a ring around each place (m) on top of all else, where the camera sees it or would but for
/// what stands before it; a place behind the camera gets none.
void draw_problem_marks(Image& image, const Camera& camera, std::span<const Vec3f> places);

} // namespace weft
