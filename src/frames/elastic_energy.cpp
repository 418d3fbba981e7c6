#include "frames/elastic_energy.h"

namespace weft {

ElasticEnergy::ElasticEnergy(const Cloth& cloth) {
    const ClothParams& params = cloth.params;
    if (params.model == Model::Corotational) {
        membrane_.emplace(cloth);
        bending_.emplace(cloth);
        return;
    }
    edges_.emplace(cloth.network, params.model, params.spring);
    if (params.model == Model::StvkTriangle) {
        triangles_.emplace(cloth);
    }
}

ElasticEnergy::ElasticEnergy(const Solid& solid) {
    edges_.emplace(solid.network, solid.params.model, solid.params.spring);
}

ElasticEnergy::Energies ElasticEnergy::measure(std::span<const Vec3> x) const {
    Energies energies{0.0, 0.0};
    if (membrane_) {
        energies = {membrane_->energy(x), bending_->energy(x)};
    }
    if (edges_) {
        energies.bending += edges_->bending_energy(x);
        energies.stretching += edges_->energy(x) - edges_->bending_energy(x);
    }
    if (triangles_) {
        energies.stretching += triangles_->energy(x);
    }
    return energies;
}

} // namespace weft
