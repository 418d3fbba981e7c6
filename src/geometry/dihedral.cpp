#include "geometry/dihedral.h"

#include <cmath>

namespace weft {

double dihedral_angle(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) {
    const Vec3 e = x1 - x0;
    const Vec3 n1 = e.cross(x2 - x0);
    const Vec3 n2 = (x3 - x0).cross(e);
    const double length = e.norm();
    if (!(length > 0.0)) {
        return 0.0;
    }
    return std::atan2(n1.cross(n2).dot(e) / length, n1.dot(n2));
}

std::array<Vec3, 4>
dihedral_gradient(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) {
    const Vec3 e = x1 - x0;
    const Vec3 n1 = e.cross(x2 - x0);
    const Vec3 n2 = (x3 - x0).cross(e);
    const double length = e.norm();
    const double n1_squared = n1.squaredNorm();
    const double n2_squared = n2.squaredNorm();
    if (!(n1_squared > 0.0 && n2_squared > 0.0)) {
        return {Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    }
    const Vec3 q1 = n1 / n1_squared;
    const Vec3 q2 = n2 / n2_squared;
    return {Vec3(((x1 - x2).dot(e) * q1 + (x1 - x3).dot(e) * q2) / length),
            Vec3(((x2 - x0).dot(e) * q1 + (x3 - x0).dot(e) * q2) / length), Vec3(-length * q1),
            Vec3(-length * q2)};
}

} // namespace weft
