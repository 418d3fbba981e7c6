#include "collide/resting.h"

#include <algorithm>

namespace weft {

namespace {

/// How near, as a share of the thickness, a pair may come that the solve carries. Smaller: nothing
/// is left to tell resting from falling in; larger: rows push against the balance that the solve
/// found.
constexpr double k_sink = 0.7;

std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

RestingContact make_resting(const ContactSurface& surface, const ContactRow& row) {
    RestingContact contact{.pair = row.vertices,
                           .vertices = {},
                           .weights = {},
                           .obstacle_velocity = Vec3::Zero(),
                           .normal = row.normal,
                           .depth = 0.0,
                           .mass = row.mass,
                           .friction = row.friction};
    Vec3 apart = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
        const Index v = row.vertices[i];
        apart += row.weights[i] * surface.start[at(v)];
        const bool deformable = surface.is_deformable(v);
        contact.vertices[i] = deformable ? v : k_no_index;
        contact.weights[i] = deformable ? row.weights[i] : 0.0;
        if (!deformable) {
            contact.obstacle_velocity += row.weights[i] * surface.velocity[at(v)];
        }
    }
    const double thickness =
        surface.rules[at(surface.rule_of(row.vertices[0], row.vertices[3]))].thickness;
    contact.depth = thickness - row.normal.dot(apart);
    return contact;
}

} // namespace

void RestingSearch::find(ContactSurface& surface,
                         const World& world,
                         std::span<const char> held,
                         double dt,
                         std::vector<RestingContact>& resting) {
    still_.assign(world.vertex_count(), Vec3::Zero());
    place_surface(surface, world, still_, held, dt);
    broad_phase_.find(surface, dt, candidates_);
    proximity_search_.find(surface, candidates_, dt, rows_);
    for (const ContactRow& row : rows_) {
        if (row.mass > 0.0) {
            resting.push_back(make_resting(surface, row));
        }
    }
}

void credit_carried(const ContactSurface& surface,
                    std::span<const RestingContact> resting,
                    double dt,
                    std::span<ContactRow> rows) {
    std::vector<const RestingContact*> sorted;
    for (const RestingContact& contact : resting) {
        if (contact.impulse > 0.0) {
            sorted.push_back(&contact);
        }
    }
    std::sort(sorted.begin(), sorted.end(),
              [](const auto* a, const auto* b) { return a->pair < b->pair; });
    for (ContactRow& row : rows) {
        const auto found = std::lower_bound(
            sorted.begin(), sorted.end(), row.vertices,
            [](const auto* contact, const auto& pair) { return contact->pair < pair; });
        if (found == sorted.end() || (*found)->pair != row.vertices) {
            continue;
        }
        const RestingContact& contact = **found;
        const double thickness =
            surface.rules[at(surface.rule_of(row.vertices[0], row.vertices[3]))].thickness;
        row.carried = contact.impulse;
        row.drag = contact.drag;
        row.least_speed =
            std::min(row.least_speed, (contact.depth - (1.0 - k_sink) * thickness) / dt);
    }
}

} // namespace weft
