#include "collide/legacy_shares.h"

#include "state/contact_legacy.h"

#include <algorithm>
#include <cmath>

namespace weft {

namespace {

auto first_not_before(std::span<const ContactMemory> memory, const std::array<Index, 4>& pair) {
    return std::lower_bound(
        memory.begin(), memory.end(), pair,
        [](const ContactMemory& one, const auto& key) { return one.pair < key; });
}

/// Calls visit(number of the legacy, claim on it) for each that a pair has a part of; claims of the
/// second side are negative, as is what it sees of the slip.
template <typename Visit>
void visit_legacies(const ContactSurface& surface,
                    std::span<const ContactMemory> memory,
                    const Contact& contact,
                    const Visit& visit) {
    const double depth = contact.rest - contact.gap;
    if (depth <= 0.0 || find_pair(memory, contact.pair) != nullptr) {
        return;
    }
    for (std::size_t i = 0; i < 4; ++i) {
        const Index v = contact.pair[i];
        const Index other = contact.pair[i < first_side(contact.kind) ? 3 : 0];
        if (!surface.is_deformable(v) || contact.weights[i] == 0.0) {
            continue;
        }
        const Index object = surface.object_of_vertex[at(other)];
        for (auto one = first_not_before(memory, legacy_pair(v, 0));
             one != memory.end() && one->pair[0] == v && is_legacy(*one); ++one) {
            if (surface.object_of_vertex[at(one->pair[3])] == object) {
                visit(static_cast<std::size_t>(one - memory.begin()), contact.weights[i] * depth);
            }
        }
    }
}

} // namespace

const ContactMemory* find_pair(std::span<const ContactMemory> memory,
                               const std::array<Index, 4>& pair) {
    const auto found = first_not_before(memory, pair);
    return found != memory.end() && found->pair == pair ? &*found : nullptr;
}

void LegacyShares::give(const ContactSurface& surface,
                        std::span<const ContactMemory> memory,
                        std::span<Contact> contacts) {
    claims_.assign(memory.size(), 0.0);
    for (const Contact& contact : contacts) {
        visit_legacies(surface, memory, contact, [&](std::size_t legacy, double claim) {
            claims_[legacy] += std::abs(claim);
        });
    }
    for (Contact& contact : contacts) {
        visit_legacies(surface, memory, contact, [&](std::size_t legacy, double claim) {
            contact.slip += claim / claims_[legacy] * memory[legacy].slip;
        });
        contact.slip -= contact.normal.dot(contact.slip) * contact.normal;
    }
}

} // namespace weft
