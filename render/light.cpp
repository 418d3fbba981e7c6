#include "render/light.h"

namespace weft {

namespace {

constexpr double k_penumbra = 0.0100; // radius of the soft edge, in half diagonals of the subject:
                                      // larger is softer, and needs more taps than 16
constexpr double k_margin = 1.05;

} // namespace

KeyLight place_key_light(const Camera& camera, const Box3& subject) {
    const Vec3 centre = subject.isEmpty() ? Vec3::Zero().eval() : subject.center();
    const double radius = std::max(subject.isEmpty() ? 0.0 : 0.5 * subject.diagonal().norm(), 1e-4);
    const Vec3 side = camera.right;
    Vec3 front = side.cross(Vec3::UnitY()); // level, towards the camera
    front.normalize();

    KeyLight light;
    light.direction = (-0.60 * side + 0.88 * Vec3::UnitY() + 0.72 * front).normalized();
    light.counter = (0.85 * side + 0.25 * Vec3::UnitY() + 0.30 * front).normalized();
    light.right = Vec3::UnitY().cross(light.direction).normalized();
    light.up = light.direction.cross(light.right);
    light.extent = 2.0 * k_margin * radius;
    light.depth = 2.0 * light.extent;
    light.kernel = k_penumbra * radius / light.extent * 2.0;

    Eigen::Matrix4d world = Eigen::Matrix4d::Identity();
    world.block<1, 3>(0, 0) = light.right.transpose() * (2.0 / light.extent);
    world.block<1, 3>(1, 0) = light.up.transpose() * (2.0 / light.extent);
    world.block<1, 3>(2, 0) = -light.direction.transpose() * (2.0 / light.depth);
    world.block<3, 1>(0, 3) = -world.block<3, 3>(0, 0) * centre;
    Eigen::Matrix4d half = Eigen::Matrix4d::Identity() * 0.5;
    half(3, 3) = 1.0;
    half.block<3, 1>(0, 3) = Vec3::Constant(0.5);
    light.to_clip = world.cast<float>();
    light.to_map = (half * world).cast<float>();
    return light;
}

} // namespace weft
