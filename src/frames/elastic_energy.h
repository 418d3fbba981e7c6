#pragma once

#include "forces/constant_bending.h"
#include "forces/edge_elements.h"
#include "forces/membrane_elements.h"
#include "forces/stvk_triangle_elements.h"
#include "state/body.h"

#include <optional>

namespace weft {

/// Elastic energy of one object by its model; keeps the elements that it sums over.
class ElasticEnergy {
public:
    explicit ElasticEnergy(const Cloth& cloth);
    explicit ElasticEnergy(const Solid& solid);

    struct Energies {
        double stretching, bending; ///< J
    };
    /// @param x  positions from the object's first vertex or particle on, m
    Energies measure(std::span<const Vec3> x) const;

private:
    std::optional<MembraneElements> membrane_;
    std::optional<ConstantBending> bending_;
    std::optional<StvkTriangleElements> triangles_;
    std::optional<EdgeElements> edges_;
};

} // namespace weft
