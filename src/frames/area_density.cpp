#include "frames/area_density.h"

#include "geometry/triangle_mesh.h"

namespace weft {

double area_density(const ClothParams& cloth, const FrameObject& first) {
    if (cloth.model == Model::Corotational) {
        return cloth.fabric.area_density;
    }
    double area = 0.0;
    for (const Triangle& t : first.triangles) {
        const auto at = [&](std::size_t k) {
            return Vec3(first.positions[static_cast<std::size_t>(t[k])].cast<double>());
        };
        area += triangle_area(at(0), at(1), at(2));
    }
    return cloth.spring.mass / area;
}

} // namespace weft
