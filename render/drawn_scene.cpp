#include "render/drawn_scene.h"

#include "render/ambient_occlusion.h"
#include "render/canvas.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace weft {

namespace {

constexpr double k_floor_reach = 2.4;    // radius of the floor, in half diagonals of the subject
constexpr double k_floor_gap = 0.002;    // floor below the subject, in half diagonals: no flicker
constexpr double k_slab_fraction = 0.02; // thickness over diagonal below which a box is a slab
constexpr int k_rings = 40;
constexpr int k_spokes = 72;

bool is_level_slab(const Box3& box, const Box3& subject) {
    const double diagonal = box.diagonal().norm();
    return diagonal > k_dwarfs * subject.diagonal().norm() &&
           box.sizes().y() < k_slab_fraction * diagonal;
}

/// A disc of rings that widen outwards, so that contact shade is fine where things stand.
Surface disc(const Vec3f& centre, float radius) {
    Surface surface;
    for (int ring = 0; ring <= k_rings; ++ring) {
        const double fraction = static_cast<double>(ring) / k_rings;
        const double r = radius * fraction * (0.4 + 0.6 * fraction);
        for (int spoke = 0; spoke < k_spokes; ++spoke) {
            const double angle = 2.0 * std::numbers::pi * spoke / k_spokes;
            surface.positions.push_back(
                centre + Vec3(r * std::sin(angle), 0.0, r * std::cos(angle)).cast<float>());
            surface.normals.push_back(Vec3f::UnitY());
            surface.values.push_back(0.0F);
            surface.ambient.emplace_back();
        }
    }
    for (Index ring = 0; ring < k_rings; ++ring) {
        for (Index spoke = 0; spoke < k_spokes; ++spoke) {
            const Index a = ring * k_spokes + spoke;
            const Index b = ring * k_spokes + (spoke + 1) % k_spokes;
            surface.triangles.push_back({a, a + k_spokes, b + k_spokes});
            surface.triangles.push_back({a, b + k_spokes, b});
        }
    }
    return surface;
}

} // namespace

DrawnScene
build_drawn_scene(const Frame& frame, int quantity, const Box3& bounds, const Vec3& eye) {
    assert(quantity >= 0 && static_cast<std::size_t>(quantity) < k_quantities.size());
    DrawnScene scene;
    scene.subject = bounds;
    const bool is_empty = scene.subject.isEmpty();
    const double radius = is_empty ? 0.0 : 0.5 * scene.subject.diagonal().norm();
    double floor_height = is_empty ? 0.0 : scene.subject.min().y() - k_floor_gap * radius;

    for (const FrameObject& object : frame.objects) {
        const std::vector<float>& values = object.values[static_cast<std::size_t>(quantity)];
        if (object.kind == ObjectKind::Cloth) {
            append_smooth(scene.cloth, object, values);
            continue;
        }
        if (object.kind == ObjectKind::Solid && !values.empty()) {
            append_creased(scene.cloth, object, values, k_solid_crease_cosine);
            continue;
        }
        const Box3 box = object_bounds(object);
        if (object.kind == ObjectKind::Obstacle && !is_empty && !box.isEmpty() &&
            is_level_slab(box, scene.subject)) {
            floor_height = box.max().y();
        } else {
            append_creased(scene.clay, object);
        }
    }
    if (radius > 0.0 && eye.y() > floor_height) {
        const Vec3 centre = scene.subject.center();
        scene.floor_centre = Vec3(centre.x(), floor_height, centre.z()).cast<float>();
        scene.floor_radius = static_cast<float>(k_floor_reach * radius);
        scene.floor = disc(scene.floor_centre, scene.floor_radius);
    }
    std::array<Surface*, 3> receivers{&scene.cloth, &scene.clay, &scene.floor};
    std::array<const Surface*, 2> casters{&scene.cloth, &scene.clay};
    add_ambient_occlusion(receivers, casters, scene.subject);
    return scene;
}

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
