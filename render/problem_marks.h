#pragma once

#include "render/camera.h"
#include "render/image.h"

namespace weft {

/// Draws a ring around each place (m) on top of all else, where the camera sees it or would but for
/// what stands before it; a place behind the camera gets none.
void draw_problem_marks(Image& image, const Camera& camera, std::span<const Vec3f> places);

} // namespace weft
