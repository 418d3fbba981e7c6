#include "geometry/mass_moments.h"

namespace weft {

MassMoments mass_moments(const TriangleMesh& mesh) {
    MassMoments moments;
    const Vec3 origin = mesh.positions[static_cast<std::size_t>(mesh.triangles[0][0])];
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();
    for (const Triangle& t : mesh.triangles) {
        const auto corner = [&](std::size_t k) {
            return Vec3(mesh.positions[static_cast<std::size_t>(t[k])] - origin);
        };
        const Vec3 a = corner(0);
        const Vec3 b = corner(1);
        const Vec3 c = corner(2);
        const double volume = a.dot(b.cross(c)) / 6.0;
        const Vec3 sum = a + b + c;
        moments.volume += volume;
        first += volume / 4.0 * sum;
        second +=
            volume / 20.0 *
            (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
    }
    const Vec3 centre = first / moments.volume;
    moments.centre = origin + centre;
    moments.second = second / moments.volume - centre * centre.transpose();
    return moments;
}

} // namespace weft
