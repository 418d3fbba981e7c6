#pragma once

#include "forces/air.h"
#include "forces/bending.h"
#include "forces/constant_bending.h"
#include "forces/edge_law.h"
#include "forces/membrane.h"
#include "forces/stvk_triangle.h"

#include <functional>
#include <type_traits>

/// Which forces a cloth has: the one list that the system, the statistics, remeshing and the tests
/// go by. A new force of cloth is one line here.
namespace weft {

/// Calls visit(std::type_identity<Elements>()) for each kind of elements that the elastic energy of
/// this cloth is made of, Elements(cloth) being the set of them.
template <typename Visit> void for_each_energy(const Cloth& cloth, const Visit& visit) {
    if (cloth.params.model == Model::Corotational) {
        visit(std::type_identity<MembraneElements>());
        visit(std::type_identity<ConstantBending>());
        return;
    }
    visit(std::type_identity<EdgeElements>());
    if (cloth.params.model == Model::StvkTriangle) {
        visit(std::type_identity<StvkTriangleElements>());
    }
}

/// Calls visit(elements) with each set of force elements of this cloth: those of its energies, then
/// those without a potential of their own.
template <typename Visit>
void for_each_force(const Cloth& cloth, const SceneParams& scene, const Visit& visit) {
    for_each_energy(cloth, [&](auto kind) {
        using Elements = typename decltype(kind)::type;
        visit(Elements(cloth));
    });
    if (cloth.params.model == Model::Corotational) {
        visit(BendDampingElements(cloth));
    }
    visit(AirElements(cloth, scene));
}

/// Elements of cloth whose mesh may change: single ones can be asked for by slot.
template <typename Elements>
concept Adaptive = requires(const Cloth& cloth, const ClothChanges& changes, Index slot) {
    Elements::slot_count(cloth);
    Elements::changed_slots(cloth, changes);
    Elements::element(cloth, slot);
};

/// Elastic energy of one object by its model; keeps the elements that it sums over.
class ElasticEnergy {
public:
    explicit ElasticEnergy(const Cloth& cloth);
    explicit ElasticEnergy(const Solid& solid);

    struct Energies {
        double stretching = 0.0, bending = 0.0; ///< J
    };
    /// @param x  positions from the object's first vertex or particle on, m
    Energies measure(std::span<const Vec3> x) const;

private:
    template <typename Elements> void add(Elements elements);

    std::vector<std::function<Energies(std::span<const Vec3>)>> parts_;
};

/// Elastic energy of a whole cloth at positions x (#V, m), J.
double elastic_energy(const Cloth& cloth, std::span<const Vec3> x);

} // namespace weft
