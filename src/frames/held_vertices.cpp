#include "frames/held_vertices.h"

#include "base/error.h"
#include "state/build_pins.h"

namespace weft {

namespace {

/// As much of a cloth as the choice of pins looks at.
Cloth cloth_of_frame(const FrameObject& object, std::span<const Vec3> positions) {
    Cloth cloth;
    cloth.name = object.name;
    cloth.vertex_count = static_cast<Index>(positions.size());
    cloth.triangles = object.triangles;
    cloth.topology = build_edges(cloth.triangles);
    for (const Triangle& t : cloth.triangles) {
        const Vec3& x0 = positions[static_cast<std::size_t>(t[0])];
        const Vec3 a = positions[static_cast<std::size_t>(t[1])] - x0;
        const Vec3 b = positions[static_cast<std::size_t>(t[2])] - x0;
        const Vec3 axis = a.normalized();
        Mat2 edges;
        edges << a.norm(), b.dot(axis), 0.0, (b - b.dot(axis) * axis).norm();
        cloth.rest.push_back({edges.inverse(), 0.5 * edges.determinant()});
    }
    return cloth;
}

} // namespace

std::vector<int> held_vertices(const FrameObject& object, const ClothParams& params) {
    std::vector<int> holder(object.positions.size(), -1);
    if (params.pins.empty()) {
        return holder;
    }
    std::vector<Vec3> positions;
    for (const Vec3f& x : object.positions) {
        positions.emplace_back(x.cast<double>());
    }
    const Cloth cloth = cloth_of_frame(object, positions);
    for (std::size_t pin = 0; pin < params.pins.size(); ++pin) {
        try {
            for (const Index v : select_pinned(cloth, params.pins[pin], pin, positions)) {
                int& by = holder[static_cast<std::size_t>(v)];
                by = by < 0 ? static_cast<int>(pin) : by;
            }
        } catch (const Error&) { // a box that selects nothing in a later frame
        }
    }
    return holder;
}

} // namespace weft
