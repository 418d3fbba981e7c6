#pragma once

#include "frames/frame.h"

namespace weft::test {

/// An upright square of cloth in the plane z = 0 around the origin, side in m, `cells` squares a
/// side; value(u, v) of every quantity, u and v in [0, 1].
template <typename Value> FrameObject square_cloth(double side, int cells, const Value& value) {
    FrameObject cloth;
    cloth.name = "square";
    cloth.fabric = "cotton";
    cloth.kind = ObjectKind::Cloth;
    for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) {
            const double u = static_cast<double>(i) / cells;
            const double v = static_cast<double>(j) / cells;
            cloth.positions.push_back(Vec3(side * (u - 0.5), side * (v - 0.5), 0.0).cast<float>());
            for (std::vector<float>& values : cloth.values) {
                values.push_back(static_cast<float>(value(u, v)));
            }
        }
    }
    for (Index j = 0; j < cells; ++j) {
        for (Index i = 0; i < cells; ++i) {
            const Index a = j * (cells + 1) + i;
            const Index b = a + cells + 1;
            cloth.triangles.push_back({a, a + 1, b + 1});
            cloth.triangles.push_back({a, b + 1, b});
        }
    }
    return cloth;
}

} // namespace weft::test
