#include "collide/friction_history.h"

#include <algorithm>
#include <cmath>

namespace weft {

namespace {

auto first_not_before(std::span<const FrictionHistory> history, const std::array<Index, 4>& pair) {
    return std::lower_bound(
        history.begin(), history.end(), pair,
        [](const FrictionHistory& one, const auto& key) { return one.pair < key; });
}

/// The history of a pair; null: it is new.
const FrictionHistory* find_pair(std::span<const FrictionHistory> history,
                                 const std::array<Index, 4>& pair) {
    const auto found = first_not_before(history, pair);
    return found != history.end() && found->pair == pair ? &*found : nullptr;
}

/// Calls visit(number of the transfer, weight) for each transfer that a contact takes part in.
/// Weights of the second side are negative, as it sees the slip the other way.
template <typename Visit>
void visit_transfers(const ContactSurface& surface,
                     std::span<const FrictionHistory> history,
                     const Contact& contact,
                     const Visit& visit) {
    const double depth = contact.rest_gap - contact.gap;
    if (depth <= 0.0 || find_pair(history, contact.pair) != nullptr) {
        return;
    }
    for (std::size_t i = 0; i < 4; ++i) {
        const Index v = contact.pair[i];
        const Index other = contact.pair[i < first_side(contact.kind) ? 3 : 0];
        if (!surface.is_deformable(v) || contact.weights[i] == 0.0) {
            continue;
        }
        const Index object = surface.object_of_vertex[at(other)];
        for (auto one = first_not_before(history, transfer_key(v, 0));
             one != history.end() && one->pair[0] == v && is_transfer(*one); ++one) {
            if (surface.object_of_vertex[at(one->pair[3])] == object) {
                visit(static_cast<std::size_t>(one - history.begin()), contact.weights[i] * depth);
            }
        }
    }
}

} // namespace

void remember(std::span<const Contact> contacts,
              std::span<const Vec3> start,
              std::span<const Vec3> end,
              std::vector<FrictionHistory>& history) {
    history.clear();
    for (const Contact& contact : contacts) {
        Vec3 moved = contact.obstacle_displacement;
        for (std::size_t i = 0; i < 4; ++i) {
            const Index v = contact.vertices[i];
            if (v != k_no_index) {
                moved += contact.weights[i] * (end[at(v)] - start[at(v)]);
            }
        }
        const double gap = contact.gap + contact.normal.dot(moved);
        if (contact.impulse > 0.0) {
            const double rest_gap =
                contact.met ? std::min(contact.rest_gap, gap) : contact.rest_gap;
            history.push_back({contact.pair, rest_gap, contact.slip, contact.slides ? 1 : 0});
        } else if (!contact.met && contact.rest_gap < contact.thickness &&
                   gap < contact.thickness) {
            history.push_back({contact.pair, contact.rest_gap, Vec3::Zero(), 0});
        }
    }
    // Of several that met in one pair the first stays.
    std::stable_sort(history.begin(), history.end(),
                     [](const auto& a, const auto& b) { return a.pair < b.pair; });
    history.erase(std::unique(history.begin(), history.end(),
                              [](const auto& a, const auto& b) { return a.pair == b.pair; }),
                  history.end());
}

void FrictionRecall::read(const ContactSurface& surface, std::span<const FrictionHistory> history) {
    history_ = history;
    of_vertex_.assign(at(surface.deformable_vertices), {});
    has_transfers_ = false;
    for (const FrictionHistory& one : history) {
        has_transfers_ = has_transfers_ || is_transfer(one);
        for (const Index v : std::span(one.pair).first(is_transfer(one) ? 1 : 4)) {
            if (surface.is_deformable(v)) {
                VertexHistory& known = of_vertex_[at(v)];
                known.rest_gap = std::max(known.rest_gap, one.rest_gap);
                known.slides = known.slides || one.slides != 0;
            }
        }
    }
}

double FrictionRecall::recall(const ContactSurface& surface, Contact& contact) const {
    double rest_gap = contact.gap;
    if (const FrictionHistory* known = find_pair(history_, contact.pair)) {
        rest_gap = known->rest_gap;
        contact.slip = known->slip - contact.normal.dot(known->slip) * contact.normal;
        contact.slides = known->slides != 0;
    } else {
        for (const Index v : contact.pair) {
            if (surface.is_deformable(v)) {
                rest_gap = std::max(rest_gap, of_vertex_[at(v)].rest_gap);
                contact.slides = contact.slides || of_vertex_[at(v)].slides;
            }
        }
    }
    return std::min(rest_gap, contact.thickness);
}

void FrictionRecall::distribute(const ContactSurface& surface, std::span<Contact> contacts) const {
    if (!has_transfers_) {
        return;
    }
    std::vector<double> weight_sum(history_.size(), 0.0); // by transfer, m
    for (const Contact& contact : contacts) {
        visit_transfers(surface, history_, contact, [&](std::size_t transfer, double weight) {
            weight_sum[transfer] += std::abs(weight);
        });
    }
    for (Contact& contact : contacts) {
        visit_transfers(surface, history_, contact, [&](std::size_t transfer, double weight) {
            contact.slip += weight / weight_sum[transfer] * history_[transfer].slip;
        });
        contact.slip -= contact.normal.dot(contact.slip) * contact.normal;
    }
}

} // namespace weft
