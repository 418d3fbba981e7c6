#include "forces/cloth_forces.h"

namespace weft {

namespace {

using Energies = ElasticEnergy::Energies;

template <typename Elements>
Energies energies_of(const Elements& elements, std::span<const Vec3> x) {
    return {elements.energy(x), 0.0};
}

Energies energies_of(const ConstantBending& bending, std::span<const Vec3> x) {
    return {0.0, bending.energy(x)};
}

Energies energies_of(const EdgeElements& edges, std::span<const Vec3> x) {
    const double bending = edges.bending_energy(x);
    return {edges.energy(x) - bending, bending};
}

} // namespace

template <typename Elements> void ElasticEnergy::add(Elements elements) {
    parts_.push_back([elements = std::move(elements)](std::span<const Vec3> x) {
        return energies_of(elements, x);
    });
}

ElasticEnergy::ElasticEnergy(const Cloth& cloth) {
    for_each_energy(cloth, [&](auto kind) {
        using Elements = typename decltype(kind)::type;
        add(Elements(cloth));
    });
}

ElasticEnergy::ElasticEnergy(const Solid& solid) {
    add(EdgeElements(solid));
}

ElasticEnergy::Energies ElasticEnergy::measure(std::span<const Vec3> x) const {
    Energies sum;
    for (const auto& part : parts_) {
        const Energies energies = part(x);
        sum.stretching += energies.stretching;
        sum.bending += energies.bending;
    }
    return sum;
}

double elastic_energy(const Cloth& cloth, std::span<const Vec3> x) {
    const auto energies = ElasticEnergy(cloth).measure(x);
    return energies.stretching + energies.bending;
}

} // namespace weft
