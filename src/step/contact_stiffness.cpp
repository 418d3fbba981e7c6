#include "step/contact_stiffness.h"

#include <algorithm>

namespace weft {

namespace {

/// The load on a single contact, at the earth's surface, uses up this share of the contact
/// thickness. Larger: heavy bodies sink in, and impulses carry them, which know nothing of what is
/// behind a surface; smaller: the solve takes longer.
constexpr double k_load_share = 0.2;
constexpr double k_earth_gravity = 9.81;

/// Share of a solid's surface that carries its load: one side of a cube.
constexpr double k_loaded_share = 1.0 / 6.0;

/// Half the sum of the membrane's moduli, or the stiffness of an edge.
double stiffness_of(const Cloth& cloth) {
    return cloth.params.model == Model::Corotational
               ? 0.5 * cloth.params.fabric.stretch_stiffness.sum()
               : cloth.params.spring.K;
}

double stiffness_under(double mass, double contacts, const Body& body) {
    return mass * k_earth_gravity / (contacts * k_load_share * body.thickness);
}

} // namespace

std::vector<double> contact_stiffness(const World& world) {
    std::vector<double> stiffness(world.vertex_count(), 0.0);
    const auto set = [&](Index first, Index count, double value) {
        std::fill_n(stiffness.begin() + first, count, value);
    };
    double rigid_mass = 0.0, heaviest = 0.0; // perhaps they lie on all others
    for (const RigidBody& rigid : world.rigids) {
        rigid_mass += rigid.params.mass;
        heaviest = std::max(heaviest, rigid.params.mass);
    }
    for (const Cloth& cloth : world.cloths) {
        set(cloth.first_vertex, cloth.vertex_count, stiffness_of(cloth));
    }
    for (const Solid& solid : world.solids) {
        const SpringParams& spring = solid.params.spring;
        const double contacts = std::max(1.0, k_loaded_share * solid.body.vertex_count);
        set(solid.body.first_vertex, solid.body.vertex_count,
            std::max(spring.K, stiffness_under(spring.mass + rigid_mass, contacts, solid.body)));
    }
    for (const RigidBody& rigid : world.rigids) {
        set(rigid.body.first_vertex, rigid.body.vertex_count,
            stiffness_under(heaviest, 1.0, rigid.body));
    }
    return stiffness;
}

} // namespace weft
