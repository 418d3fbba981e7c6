#include "render/problem_marks.h"

#include "render/canvas.h"

#include <algorithm>

namespace weft {

namespace {

// Lengths in pixels of a picture with 720 lines: large enough to find one in a whole picture.
constexpr double k_radius = 9.0;
constexpr double k_width = 2.6;
constexpr double k_rim = 1.3; // dark on both sides, so that it shows on any colour
const Colour k_ring{1.0F, 0.92F, 0.0F};
const Colour k_dark{0.05F, 0.02F, 0.02F};

} // namespace

void draw_problem_marks(Image& image, const Camera& camera, std::span<const Vec3f> places) {
    const double s = std::max(0.6, image.height / 720.0);
    const std::array<int, 2> size{image.width, image.height};
    std::vector<Vec3> centres;
    for (const Vec3f& place : places) {
        const Vec3 centre = project(camera, size, place.cast<double>());
        if (centre.z() > 0.0) {
            centres.push_back(centre);
        }
    }
    // The dark first of all, so that rings near each other do not blot one another out.
    for (const Vec3& c : centres) {
        draw_ring(image, {c.x(), c.y()}, k_radius * s, (k_width + 2.0 * k_rim) * s, k_dark);
    }
    for (const Vec3& c : centres) {
        draw_ring(image, {c.x(), c.y()}, k_radius * s, k_width * s, k_ring);
    }
}

} // namespace weft
