#pragma once

#include "forces/cloth_forces.h"

namespace weft::test {

/// Elastic energy of a whole cloth at positions x (#V, m), and that of its weight, J.
inline double surface_energy(const Cloth& cloth, std::span<const Vec3> x, const Vec3& gravity) {
    double energy = elastic_energy(cloth, x);
    for (std::size_t v = 0; v < x.size(); ++v) {
        energy -= cloth.params.fabric.area_density * cloth.rest_areas[v] * gravity.dot(x[v]);
    }
    return energy;
}

} // namespace weft::test
