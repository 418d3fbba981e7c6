#include "step/contact_forces.h"

#include "base/parallel.h"

#include <algorithm>
#include <cassert>

namespace weft {

namespace {

std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

Vec3 across(const Vec3& v, const Vec3& normal) {
    return v - normal.dot(v) * normal;
}

} // namespace

void ContactForces::start(std::span<const Vec3> start, double dt) {
    start_ = start;
    dt_ = dt;
    contacts_ = {};
    springs_.clear();
    ++revision_;
}

void ContactForces::take(std::span<const Contact> contacts) {
    assert(contacts.size() >= springs_.size());
    contacts_ = contacts;
    ++revision_;
    for (const Contact& contact : contacts.subspan(springs_.size())) {
        double stiffness = 0.0;
        double weight = 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
            if (contact.vertices[i] != k_no_index) {
                stiffness += std::abs(contact.weights[i]) * stiffness_[at(contact.vertices[i])];
                weight += std::abs(contact.weights[i]);
            }
        }
        stiffness /= weight;
        springs_.push_back(
            {{stiffness, std::max(contact.room, 1e-3 * contact.thickness)}, {stiffness, 0.0}});
    }
}

bool ContactForces::is_internal() const {
    return std::all_of(contacts_.begin(), contacts_.end(), [](const Contact& contact) {
        return std::find(contact.vertices.begin(), contact.vertices.end(), k_no_index) ==
               contact.vertices.end();
    });
}

Vec3 ContactForces::relative(const Contact& contact, std::span<const Vec3> values) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
        if (contact.vertices[i] != k_no_index) {
            sum += contact.weights[i] * values[at(contact.vertices[i])];
        }
    }
    return sum;
}

ContactForces::Place ContactForces::place(const Contact& contact, std::span<const Vec3> x) const {
    const Vec3 moved = relative(contact, x) - relative(contact, start_) + contact.driven;
    return {contact.rest - contact.gap - contact.normal.dot(moved),
            contact.slip + across(moved, contact.normal)};
}

void ContactForces::fit_limits(std::span<const Vec3> x) {
    parallel_for(springs_.size(), [&](std::size_t c) {
        const Contact& contact = contacts_[c];
        const double friction = contact.slides ? contact.friction : contact.static_friction;
        springs_[c].hold.limit = friction * springs_[c].push.force(place(contact, x).approach);
    });
}

void ContactForces::add_forces(std::span<const Vec3> x, std::span<Vec3> forces) const {
    for (std::size_t c = 0; c < springs_.size(); ++c) {
        const Contact& contact = contacts_[c];
        const Place now = place(contact, x);
        const Vec3 force = springs_[c].push.force(now.approach) * contact.normal +
                           springs_[c].hold.force(now.across);
        for (std::size_t i = 0; i < 4; ++i) {
            if (contact.vertices[i] != k_no_index) {
                forces[at(contact.vertices[i])] += contact.weights[i] * force;
            }
        }
    }
}

void ContactForces::trace(std::span<const Vec3> x, std::span<const Vec3> motion) {
    at_.resize(springs_.size());
    along_.resize(springs_.size());
    parallel_for(springs_.size(), [&](std::size_t c) {
        const Vec3 moved = relative(contacts_[c], motion);
        at_[c] = place(contacts_[c], x);
        along_[c] = {-contacts_[c].normal.dot(moved), across(moved, contacts_[c].normal)};
    });
}

double ContactForces::work_along(double share) const {
    return parallel_sum(springs_.size(), [&](std::size_t c) {
        const double approach = at_[c].approach + share * along_[c].approach;
        const Vec3 slip = at_[c].across + share * along_[c].across;
        return springs_[c].hold.force(slip).dot(along_[c].across) -
               springs_[c].push.force(approach) * along_[c].approach;
    });
}

void ContactForces::find_places(std::span<const Index> row_of_vertex,
                                std::span<const char> held,
                                const BlockMatrix& matrix) {
    places_.resize(contacts_.size());
    parallel_for(contacts_.size(), [&](std::size_t c) {
        const Contact& contact = contacts_[c];
        const auto moves = [&](std::size_t i) {
            const Index v = contact.vertices[i];
            return v != k_no_index && contact.weights[i] != 0.0 && held[at(v)] == 0;
        };
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < 4; ++j) {
                places_[c][4 * i + j] =
                    moves(i) && moves(j)
                        ? find_block(matrix, row_of_vertex[at(contact.vertices[i])],
                                     row_of_vertex[at(contact.vertices[j])])
                        : k_no_index;
            }
        }
    });
}

void ContactForces::add_blocks(std::span<const Vec3> x,
                               double scale,
                               double caution,
                               BlockMatrix& matrix) {
    assert(places_.size() == springs_.size());
    blocks_.resize(springs_.size());
    parallel_for(springs_.size(), [&](std::size_t c) {
        const Place now = place(contacts_[c], x);
        const double push = springs_[c].push.tangent(now.approach);
        const Vec3& n = contacts_[c].normal;
        const Mat3 along = n * n.transpose();
        const Mat3 plane = Mat3::Identity() - along;
        blocks_[c] =
            push == 0.0
                ? Mat3(Mat3::Zero())
                : Mat3(scale *
                       (push * along +
                        plane * springs_[c].hold.cautious_tangent(now.across, caution) * plane));
    });
    // Contacts share blocks: one after the other.
    for (std::size_t c = 0; c < springs_.size(); ++c) {
        if (blocks_[c](0, 0) == 0.0 && blocks_[c].isZero(0.0)) {
            continue;
        }
        const auto& weights = contacts_[c].weights;
        for (std::size_t k = 0; k < 16; ++k) {
            if (places_[c][k] != k_no_index) {
                matrix.blocks[at(places_[c][k])] += weights[k / 4] * weights[k % 4] * blocks_[c];
            }
        }
    }
}

void ContactForces::list_blocks(std::span<const Index> row_of_vertex,
                                std::vector<BlockEntry>& entries) const {
    entries.clear();
    for (const Contact& contact : contacts_) {
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                const bool both = contact.vertices[i] != k_no_index &&
                                  contact.vertices[j] != k_no_index &&
                                  contact.weights[i] * contact.weights[j] != 0.0;
                if (both) {
                    entries.push_back({row_of_vertex[at(contact.vertices[i])],
                                       row_of_vertex[at(contact.vertices[j])]});
                }
            }
        }
    }
}

void ContactForces::report(std::span<const Vec3> x, std::span<Contact> contacts) const {
    assert(contacts.size() == springs_.size());
    for (std::size_t c = 0; c < springs_.size(); ++c) {
        const Place end = place(contacts[c], x);
        const Spring& spring = springs_[c];
        contacts[c].impulse = dt_ * spring.push.force(end.approach);
        contacts[c].drag = dt_ * spring.hold.force(end.across);
        contacts[c].slip = spring.hold.kept(end.across);
        contacts[c].slides = (end.across - contacts[c].slip).norm() > k_sliding_speed * dt_;
    }
}

} // namespace weft
