#include "step/contact_forces.h"

#include "base/parallel.h"

#include <algorithm>
#include <cassert>

namespace weft {

namespace {

/// The load on a single contact, at the earth's surface, presses it by this fraction of the contact
/// thickness. Larger: heavy bodies sink in until impulses carry them, which know nothing of the
/// material behind a surface; smaller: the solve takes longer.
constexpr double k_load_fraction = 0.2;
constexpr double k_earth_gravity = 9.81;

/// Fraction of a solid's surface that bears its load: one side of a cube.
constexpr double k_loaded_fraction = 1.0 / 6.0;

double stiffness_under(double mass, double contacts, const Body& body) {
    return mass * k_earth_gravity / (contacts * k_load_fraction * body.thickness);
}

Vec3 tangential(const Vec3& v, const Vec3& normal) {
    return v - normal.dot(v) * normal;
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
        set(cloth.first_vertex, cloth.vertex_count, material_stiffness(cloth.params));
    }
    for (const Solid& solid : world.solids) {
        const SpringParams& spring = solid.params.spring;
        const double contacts = std::max(1.0, k_loaded_fraction * solid.body.vertex_count);
        set(solid.body.first_vertex, solid.body.vertex_count,
            std::max(spring.K, stiffness_under(spring.mass + rigid_mass, contacts, solid.body)));
    }
    for (const RigidBody& rigid : world.rigids) {
        set(rigid.body.first_vertex, rigid.body.vertex_count,
            stiffness_under(heaviest, 1.0, rigid.body));
    }
    return stiffness;
}

void ContactForces::start(std::span<const Vec3> start, double dt) {
    start_ = start;
    dt_ = dt;
    contacts_ = {};
    springs_.clear();
    terms_.clear();
    terms_begin_.assign(1, 0);
    pair_begin_.assign(1, 0);
    ++revision_;
}

std::span<const ContactForces::Term> ContactForces::terms(std::size_t contact) const {
    return std::span(terms_).subspan(terms_begin_[contact],
                                     terms_begin_[contact + 1] - terms_begin_[contact]);
}

void ContactForces::take(std::span<const Contact> contacts) {
    assert(contacts.size() >= springs_.size());
    contacts_ = contacts;
    ++revision_;
    for (const Contact& contact : contacts.subspan(springs_.size())) {
        const double stiffness = stiffness_of(contact);
        springs_.push_back({{stiffness, std::max(contact.barrier_width, 1e-3 * contact.thickness)},
                            {stiffness, 0.0}});
        add_terms(contact);
    }
}

double ContactForces::stiffness_of(const Contact& contact) const {
    double stiffness = 0.0;
    double weight = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        if (contact.vertices[i] != k_no_index) {
            stiffness += std::abs(contact.weights[i]) * stiffness_[at(contact.vertices[i])];
            weight += std::abs(contact.weights[i]);
        }
    }
    return stiffness / weight;
}

void ContactForces::add_terms(const Contact& contact) {
    const std::size_t first = terms_.size();
    for (std::size_t i = 0; i < 4; ++i) {
        const Index v = contact.vertices[i];
        if (v == k_no_index) {
            continue;
        }
        const Embedding* embedding = embeddings_.find(v);
        if (embedding == nullptr) {
            terms_.push_back({v, contact.weights[i]});
            continue;
        }
        for (std::size_t k = 0; k < 4 && embedding->particles[k] != k_no_index; ++k) {
            add_term(first, embedding->particles[k], contact.weights[i] * embedding->weights[k]);
        }
    }
    terms_begin_.push_back(terms_.size());
    const std::size_t count = terms_.size() - first;
    pair_begin_.push_back(pair_begin_.back() + count * count);
}

/// Adds to the terms of the contact at hand, which begin at `first`.
void ContactForces::add_term(std::size_t first, Index vertex, double weight) {
    const auto known = std::find_if(terms_.begin() + static_cast<long>(first), terms_.end(),
                                    [&](const Term& term) { return term.vertex == vertex; });
    if (known == terms_.end()) {
        terms_.push_back({vertex, weight});
    } else {
        known->weight += weight;
    }
}

bool ContactForces::is_internal() const {
    return std::all_of(contacts_.begin(), contacts_.end(), [](const Contact& contact) {
        return std::find(contact.vertices.begin(), contact.vertices.end(), k_no_index) ==
               contact.vertices.end();
    });
}

Vec3 ContactForces::relative(std::size_t contact, std::span<const Vec3> values) const {
    Vec3 sum = Vec3::Zero();
    for (const Term& term : terms(contact)) {
        sum += term.weight * values[at(term.vertex)];
    }
    return sum;
}

ContactForces::Deflection ContactForces::deflection(std::size_t c, std::span<const Vec3> x) const {
    const Contact& contact = contacts_[c];
    const Vec3 moved = relative(c, x) - relative(c, start_) + contact.obstacle_displacement;
    return {contact.rest_gap - contact.gap - contact.normal.dot(moved),
            contact.slip + tangential(moved, contact.normal)};
}

void ContactForces::fit_limits(std::span<const Vec3> x) {
    parallel_for(springs_.size(), [&](std::size_t c) {
        const Contact& contact = contacts_[c];
        springs_[c].friction.limit =
            friction_limit(contact, springs_[c].normal.force(deflection(c, x).approach));
    });
}

void ContactForces::add_forces(std::span<const Vec3> x, std::span<Vec3> forces) const {
    for (std::size_t c = 0; c < springs_.size(); ++c) {
        const Deflection now = deflection(c, x);
        const Vec3 force = springs_[c].normal.force(now.approach) * contacts_[c].normal +
                           springs_[c].friction.force(now.tangential);
        for (const Term& term : terms(c)) {
            forces[at(term.vertex)] += term.weight * force;
        }
    }
}

void ContactForces::trace(std::span<const Vec3> x, std::span<const Vec3> motion) {
    deflections_.resize(springs_.size());
    deflection_rates_.resize(springs_.size());
    parallel_for(springs_.size(), [&](std::size_t c) {
        const Vec3 moved = relative(c, motion);
        deflections_[c] = deflection(c, x);
        deflection_rates_[c] = {-contacts_[c].normal.dot(moved),
                                tangential(moved, contacts_[c].normal)};
    });
}

double ContactForces::work_along(double alpha) const {
    return parallel_sum(springs_.size(), [&](std::size_t c) {
        const double approach = deflections_[c].approach + alpha * deflection_rates_[c].approach;
        const Vec3 slip = deflections_[c].tangential + alpha * deflection_rates_[c].tangential;
        return springs_[c].friction.force(slip).dot(deflection_rates_[c].tangential) -
               springs_[c].normal.force(approach) * deflection_rates_[c].approach;
    });
}

void ContactForces::find_blocks(std::span<const Index> row_of_vertex,
                                std::span<const char> constrained,
                                const BlockMatrix& matrix) {
    term_blocks_.resize(pair_begin_.back());
    parallel_for(contacts_.size(), [&](std::size_t c) {
        const auto moves = [&](const Term& term) {
            return term.weight != 0.0 && constrained[at(term.vertex)] == 0;
        };
        std::size_t k = pair_begin_[c];
        for (const Term& row : terms(c)) {
            for (const Term& column : terms(c)) {
                term_blocks_[k++] = moves(row) && moves(column)
                                        ? find_block(matrix, row_of_vertex[at(row.vertex)],
                                                     row_of_vertex[at(column.vertex)])
                                        : k_no_index;
            }
        }
    });
}

void ContactForces::add_blocks(std::span<const Vec3> x,
                               double scale,
                               double damping,
                               BlockMatrix& matrix) {
    assert(term_blocks_.size() == pair_begin_.back());
    blocks_.resize(springs_.size());
    parallel_for(springs_.size(), [&](std::size_t c) {
        const Deflection now = deflection(c, x);
        const double normal = springs_[c].normal.tangent(now.approach);
        const Vec3& n = contacts_[c].normal;
        const Mat3 along = n * n.transpose();
        const Mat3 plane = Mat3::Identity() - along;
        blocks_[c] = normal == 0.0
                         ? Mat3(Mat3::Zero())
                         : Mat3(scale * (normal * along + plane *
                                                              springs_[c].friction.damped_tangent(
                                                                  now.tangential, damping) *
                                                              plane));
    });
    // Contacts share blocks: one after the other.
    for (std::size_t c = 0; c < springs_.size(); ++c) {
        if (blocks_[c](0, 0) == 0.0 && blocks_[c].isZero(0.0)) {
            continue;
        }
        std::size_t k = pair_begin_[c];
        for (const Term& row : terms(c)) {
            for (const Term& column : terms(c)) {
                if (const Index place = term_blocks_[k++]; place != k_no_index) {
                    matrix.blocks[at(place)] += row.weight * column.weight * blocks_[c];
                }
            }
        }
    }
}

void ContactForces::list_blocks(std::span<const Index> row_of_vertex,
                                std::vector<BlockEntry>& entries) const {
    entries.clear();
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
        const std::span<const Term> all = terms(c);
        for (std::size_t i = 0; i < all.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if (all[i].weight * all[j].weight != 0.0) {
                    entries.push_back(
                        {row_of_vertex[at(all[i].vertex)], row_of_vertex[at(all[j].vertex)]});
                }
            }
        }
    }
}

void ContactForces::report(std::span<const Vec3> x, std::span<Contact> contacts) const {
    assert(contacts.size() == springs_.size());
    for (std::size_t c = 0; c < springs_.size(); ++c) {
        const Deflection end = deflection(c, x);
        const Spring& spring = springs_[c];
        contacts[c].impulse = dt_ * spring.normal.force(end.approach);
        contacts[c].friction_impulse = dt_ * spring.friction.force(end.tangential);
    }
    report_slips(x, contacts);
}

void ContactForces::report_slips(std::span<const Vec3> x, std::span<Contact> contacts) const {
    for (std::size_t c = 0; c < springs_.size(); ++c) {
        const Deflection end = deflection(c, x);
        contacts[c].slip = springs_[c].friction.kept(end.tangential);
        contacts[c].slides = is_sliding((end.tangential - contacts[c].slip).norm(), dt_);
    }
}

} // namespace weft
