#include "state/cloth.h"

#include <cassert>
#include <cmath>

namespace weft {

MembraneStiffness membrane_stiffness(const FabricParams& fabric) {
    assert(fabric.poisson >= 0.0 && fabric.poisson < 1.0);
    const double e1 = fabric.stretch_stiffness(0);
    const double e2 = fabric.stretch_stiffness(1);
    const double inverse = 1.0 / (1.0 - fabric.poisson * fabric.poisson);
    return {e1 * inverse, fabric.poisson * std::sqrt(e1 * e2) * inverse, e2 * inverse,
            fabric.shear_stiffness};
}

} // namespace weft
