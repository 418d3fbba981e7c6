#include "collide/contact_search.h"

#include "base/parallel.h"
#include "collide/proximity.h"
#include "state/contact_legacy.h"

#include <algorithm>

namespace weft {

namespace {

/// Share of the rest gap that pushing sides may use up. Larger: heavy loads are carried more
/// softly; smaller: nothing is left between the least gap and where impacts are felt.
constexpr double k_room = 0.7;

constexpr std::size_t k_chunk_candidates = 512;

/// How a gap turns with the body that an obstacle's vertex belongs to, m: what sticks to the body
/// at a distance moves with the body's motion there, not with that of the body's surface.
Vec3 turn_of_gap(const ContactSurface& surface, Index vertex, const Vec3& gap) {
    const ContactObject& object = surface.objects[at(surface.object_of_vertex[at(vertex)])];
    return object.end.rotation * (object.start.rotation.transpose() * gap) - gap;
}

/// Gap and motion of a pair whose closest points are those of `place`.
Contact make_contact(const ContactSurface& surface,
                     const Candidate& candidate,
                     const Separation& place,
                     double dt) {
    const ContactRow row = make_row(surface, candidate, place, dt);
    const PairRule& rule = surface.rules[at(candidate.rule)];
    const double thickness = surface.thickness_of(candidate.vertices, candidate.kind);
    Contact contact{.pair = candidate.vertices,
                    .kind = candidate.kind,
                    .vertices = candidate.vertices,
                    .weights = row.weights,
                    .normal = row.normal,
                    .gap = 0.0,
                    .thickness = thickness,
                    .rest = thickness,
                    .room = k_room * thickness,
                    .mass = row.mass,
                    .friction = rule.friction,
                    .static_friction = rule.static_friction,
                    .driven = Vec3::Zero()};
    Vec3 apart = Vec3::Zero();
    Vec3 speed = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
        const Index v = candidate.vertices[i];
        apart += row.weights[i] * surface.start[at(v)];
        speed += row.weights[i] * surface.velocity[at(v)];
        if (!surface.is_deformable(v)) {
            contact.vertices[i] = k_no_index;
            contact.driven += dt * row.weights[i] * surface.velocity[at(v)];
        }
    }
    contact.gap = row.normal.dot(apart);
    for (const Index v : {candidate.vertices[0], candidate.vertices[3]}) {
        if (!surface.is_deformable(v)) {
            const Vec3 turn = turn_of_gap(surface, v, apart);
            contact.driven -= turn - row.normal.dot(turn) * row.normal;
        }
    }
    contact.slides = (speed - row.normal.dot(speed) * row.normal).norm() > k_sliding_speed;
    return contact;
}

} // namespace

void ContactSearch::note_vertices(const ContactSurface& surface,
                                  std::span<const ContactMemory> memory) {
    of_vertex_.assign(at(surface.deformable_vertices), {});
    has_legacies_ = false;
    for (const ContactMemory& one : memory) {
        has_legacies_ = has_legacies_ || is_legacy(one);
        for (const Index v : std::span(one.pair).first(is_legacy(one) ? 1 : 4)) {
            if (surface.is_deformable(v)) {
                VertexMemory& known = of_vertex_[at(v)];
                known.rest = std::max(known.rest, one.rest);
                known.slides = known.slides || one.slides != 0;
            }
        }
    }
}

void ContactSearch::recall(const ContactSurface& surface,
                           std::span<const ContactMemory> memory,
                           double dt,
                           Contact& contact) const {
    double rest = contact.gap;
    if (const ContactMemory* known = find_pair(memory, contact.pair)) {
        rest = known->rest;
        contact.slip = known->slip - contact.normal.dot(known->slip) * contact.normal;
        contact.slides = known->slides != 0;
    } else {
        for (const Index v : contact.pair) {
            if (surface.is_deformable(v)) {
                rest = std::max(rest, of_vertex_[at(v)].rest);
                contact.slides = contact.slides || of_vertex_[at(v)].slides;
            }
        }
    }
    rest = std::min(rest, contact.thickness);
    contact.rest = rest + (contact.thickness - rest) * parting_share(dt);
    contact.room = k_room * contact.rest;
}

void ContactSearch::find(const ContactSurface& surface,
                         std::span<const Candidate> candidates,
                         std::span<const ContactMemory> memory,
                         double dt,
                         std::vector<Contact>& contacts) {
    note_vertices(surface, memory);
    const std::size_t chunks = (candidates.size() + k_chunk_candidates - 1) / k_chunk_candidates;
    found_.resize(std::max(found_.size(), chunks));
    parallel_chunks(
        candidates.size(),
        [&](std::size_t begin, std::size_t end) {
            auto& out = found_[begin / k_chunk_candidates];
            out.clear();
            for (const Candidate& candidate : candidates.subspan(begin, end - begin)) {
                const auto place = near_place(surface, candidate);
                if (place && place->distance > 0.0) {
                    Contact contact = make_contact(surface, candidate, *place, dt);
                    if (contact.mass > 0.0) {
                        recall(surface, memory, dt, contact);
                        out.push_back(contact);
                    }
                }
            }
        },
        k_chunk_candidates);
    contacts.clear();
    for (std::size_t c = 0; c < chunks; ++c) {
        contacts.insert(contacts.end(), found_[c].begin(), found_[c].end());
    }
    if (has_legacies_) {
        shares_.give(surface, memory, contacts);
    }
}

Contact make_impact_contact(const ContactSurface& surface,
                            const Candidate& candidate,
                            double toi,
                            double dt) {
    const PairPoints start = start_points(surface, candidate.vertices);
    const PairPoints motion = displacements(surface, candidate.vertices, dt);
    PairPoints x = start;
    for (std::size_t i = 0; i < 4; ++i) {
        x[i] += toi * motion[i];
    }
    Contact contact = make_contact(surface, candidate, separation(candidate.kind, x), dt);
    contact.met = true;
    contact.rest = std::min(contact.rest, contact.gap);
    contact.room = std::min(contact.room, k_room * separation(candidate.kind, start).distance);
    return contact;
}

void remember(std::span<const Contact> contacts,
              std::span<const Vec3> start,
              std::span<const Vec3> end,
              std::vector<ContactMemory>& memory) {
    memory.clear();
    for (const Contact& contact : contacts) {
        Vec3 moved = contact.driven;
        for (std::size_t i = 0; i < 4; ++i) {
            const Index v = contact.vertices[i];
            if (v != k_no_index) {
                moved += contact.weights[i] * (end[at(v)] - start[at(v)]);
            }
        }
        const double gap = contact.gap + contact.normal.dot(moved);
        if (contact.impulse > 0.0) {
            const double rest = contact.met ? std::min(contact.rest, gap) : contact.rest;
            memory.push_back({contact.pair, rest, contact.slip, contact.slides ? 1 : 0});
        } else if (!contact.met && contact.rest < contact.thickness && gap < contact.thickness) {
            memory.push_back({contact.pair, contact.rest, Vec3::Zero(), 0});
        }
    }
    // Of several that met in one pair the first stays.
    std::stable_sort(memory.begin(), memory.end(),
                     [](const auto& a, const auto& b) { return a.pair < b.pair; });
    memory.erase(std::unique(memory.begin(), memory.end(),
                             [](const auto& a, const auto& b) { return a.pair == b.pair; }),
                 memory.end());
}

ContactRow guard_row(const Contact& contact, double dt) {
    const double least_gap = std::min((1.0 - k_room) * contact.thickness, 0.8 * contact.gap);
    return {.vertices = contact.pair,
            .weights = contact.weights,
            .kind = contact.kind,
            .normal = contact.normal,
            .mass = contact.mass,
            .least_speed = (least_gap - contact.gap) / dt,
            .friction = 0.0};
}

} // namespace weft
