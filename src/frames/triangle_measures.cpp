#include "frames/triangle_measures.h"

#include "base/parallel.h"

namespace weft {

std::vector<StrainMeasures> measure_triangles(const World& world, const Cloth& cloth) {
    const auto x = world.positions_of(cloth);
    const MembraneStiffness stiffness = membrane_stiffness(cloth.params.fabric);
    std::vector<StrainMeasures> measures(cloth.triangles.size());
    parallel_for(measures.size(), [&](std::size_t t) {
        const auto corner = [&](std::size_t k) {
            return x[static_cast<std::size_t>(cloth.triangles[t][k])];
        };
        measures[t] = strain_measures({corner(0), corner(1), corner(2)}, cloth.rest[t], stiffness);
    });
    return measures;
}

} // namespace weft
