#include "step/contact_forces.h"

namespace weft {

namespace {

/// Friction may pass Coulomb's limit by this share before it is revised.
constexpr double k_cone_slack = 0.01;

std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

/// Sum of weight * value over the deformable's vertices.
Vec3 weighted(const RestingContact& contact, std::span<const Vec3> values) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
        if (contact.weights[i] != 0.0) {
            sum += contact.weights[i] * values[at(contact.vertices[i])];
        }
    }
    return sum;
}

Vec3 across(const Vec3& v, const Vec3& normal) {
    return v - normal.dot(v) * normal;
}

} // namespace

void ContactForces::start(std::span<const RestingContact> contacts,
                          std::span<const Vec3> start,
                          std::span<const Vec3> velocities,
                          std::span<const Vec3> free_velocities,
                          double dt) {
    active_.clear();
    dt_ = dt;
    start_.assign(start.begin(), start.end());
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const RestingContact& contact = contacts[c];
        const double approach = -dt * contact.normal.dot(weighted(contact, free_velocities) +
                                                         contact.obstacle_velocity);
        if (contact.depth + std::max(approach, 0.0) <= 0.0) {
            continue;
        }
        double stiffness = 0.0;
        double weight = 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
            if (contact.weights[i] != 0.0) {
                stiffness += std::abs(contact.weights[i]) * stiffness_[at(contact.vertices[i])];
                weight += std::abs(contact.weights[i]);
            }
        }
        stiffness /= weight;
        const double limit = contact.friction * stiffness * std::max(contact.depth, 0.0);
        const double slip =
            across(weighted(contact, velocities) + contact.obstacle_velocity, contact.normal)
                .norm();
        const double hold = stiffness * dt;
        active_.push_back(
            {static_cast<Index>(c), contact, stiffness, hold,
             limit * dt >= contact.mass * slip ? hold : std::min(hold, limit / slip)});
    }
}

bool ContactForces::revise(std::span<const Vec3> x, std::span<const Vec3> v) {
    bool changed = false;
    for (Active& active : active_) {
        const double load = push(active, x);
        if (load < 0.0) {
            active.stiffness = 0.0;
            active.damping = 0.0;
            changed = true;
            continue;
        }
        const double limit = active.geometry.friction * load;
        const double held = drag(active, v).norm();
        if (active.damping == 0.0 || held <= 0.0) {
            continue;
        }
        const double slip = held / active.damping;
        if (held > (1.0 + k_cone_slack) * limit) {
            // What the damper held too much will speed the contact up.
            active.damping = limit / (slip + (held - limit) * dt_ / active.geometry.mass);
            changed = true;
        } else if (active.damping < active.hold && held < (1.0 - k_cone_slack) * limit) {
            active.damping = std::min(active.hold, limit / slip);
            changed = true;
        }
    }
    return changed;
}

double ContactForces::push(const Active& active, std::span<const Vec3> x) const {
    const RestingContact& contact = active.geometry;
    const double moved = contact.normal.dot(weighted(contact, x) - weighted(contact, start_) +
                                            dt_ * contact.obstacle_velocity);
    return active.stiffness * (contact.depth - moved);
}

Vec3 ContactForces::drag(const Active& active, std::span<const Vec3> v) const {
    const RestingContact& contact = active.geometry;
    return -active.damping *
           across(weighted(contact, v) + contact.obstacle_velocity, contact.normal);
}

void ContactForces::add_forces(std::span<const Vec3> x,
                               std::span<const Vec3> v,
                               std::span<Vec3> forces) const {
    for (const Active& active : active_) {
        const Vec3 force = push(active, x) * active.geometry.normal + drag(active, v);
        for (std::size_t i = 0; i < 4; ++i) {
            if (active.geometry.weights[i] != 0.0) {
                forces[at(active.geometry.vertices[i])] += active.geometry.weights[i] * force;
            }
        }
    }
}

void ContactForces::add_blocks(double beta,
                               std::span<const Index> row_of_vertex,
                               BlockMatrix& matrix) const {
    for (const Active& active : active_) {
        const RestingContact& contact = active.geometry;
        const Mat3 along = contact.normal * contact.normal.transpose();
        const Mat3 block = beta * beta * active.stiffness * along +
                           beta * active.damping * (Mat3::Identity() - along);
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < 4; ++j) {
                const double weight = contact.weights[i] * contact.weights[j];
                if (weight != 0.0) {
                    const Index place = find_block(matrix, row_of_vertex[at(contact.vertices[i])],
                                                   row_of_vertex[at(contact.vertices[j])]);
                    matrix.blocks[at(place)] += weight * block;
                }
            }
        }
    }
}

void ContactForces::report(std::span<const Vec3> x,
                           std::span<const Vec3> v,
                           std::span<RestingContact> contacts) const {
    for (const Active& active : active_) {
        RestingContact& contact = contacts[at(active.contact)];
        contact.impulse = std::max(0.0, dt_ * push(active, x));
        contact.drag = dt_ * drag(active, v);
    }
}

} // namespace weft
