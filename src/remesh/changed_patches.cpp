#include "remesh/changed_patches.h"

#include "base/disjoint_sets.h"
#include "forces/cloth_forces.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <tuple>

namespace weft {

namespace {

/// What stood before in slots that changed, of an array that had `count` elements.
std::vector<Index>
slots_before(const std::vector<Index>& now, std::size_t count_now, std::size_t count) {
    std::vector<Index> before;
    std::copy_if(now.begin(), now.end(), std::back_inserter(before),
                 [&](Index slot) { return at(slot) < count; });
    for (std::size_t slot = count_now; slot < count; ++slot) {
        before.push_back(static_cast<Index>(slot));
    }
    return before;
}

/// Numbers that vertices keep through an adaptation: the slot before, or one behind all those.
std::vector<Index>
lasting_numbers(std::size_t old_count, std::size_t count, const ClothChanges& changes) {
    std::vector<Index> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0);
    for (const ClothChanges::Vertex& change : changes.vertices) {
        if (at(change.slot) < count) {
            numbers[at(change.slot)] = change.from == k_no_index
                                           ? static_cast<Index>(old_count) + change.slot
                                           : change.from;
        }
    }
    return numbers;
}

/// The elements of a cloth that an adaptation changed, as they were or as they are.
class Side {
public:
    /// @param numbers  that vertices keep; empty: their slots
    Side(const PlacedCloth& placed, std::vector<Index> numbers)
        : placed_(placed), numbers_(std::move(numbers)) {}

    template <Adaptive Elements> void add(const std::vector<Index>& slots) {
        for (const Index slot : slots) {
            auto element = Elements::element(placed_.cloth, slot);
            if (!element.empty()) {
                std::get<std::vector<decltype(element)>>(elements_).push_back(element);
            }
        }
    }

    /// The vertices of the triangles, ascending.
    std::vector<Index> vertices() const {
        std::vector<Index> vertices;
        for (const MembraneTriangle& triangle : std::get<0>(elements_)) {
            vertices.insert(vertices.end(), triangle.nodes.begin(), triangle.nodes.end());
        }
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        return vertices;
    }
    Index number(Index v) const { return numbers_.empty() ? v : numbers_[at(v)]; }

    /// Joins what shares an element.
    void join(DisjointSets& sets) const {
        for_each_element([&](const auto& element) {
            for (int a = 1; a < element.count; ++a) {
                if (element.has(a)) {
                    sets.join(number(element.node(0)), number(element.node(a)));
                }
            }
        });
    }

    /// Calls add(number, energy) for all that has energy, each with a vertex of its own.
    template <typename Add> void add_energies(const Vec3& gravity, const Add& add) const {
        for_each_element(
            [&](const auto& element) { add(number(element.node(0)), element.energy(placed_.x)); });
        const Cloth& cloth = placed_.cloth;
        for (const Index v : vertices()) { // the sum of the masses is the same before and after
            const double mass = cloth.params.fabric.area_density * cloth.rest_areas[at(v)];
            add(number(v), -mass * gravity.dot(placed_.x[at(v)] - placed_.x[0]));
        }
    }

    /// Calls add(number, force) for the elastic forces of all elements.
    template <typename Add> void add_forces(const Add& add) const {
        for_each_element([&](const auto& element) {
            element.for_each_force(placed_.x,
                                   [&](Index v, const Vec3& force) { add(number(v), force); });
        });
    }

private:
    template <typename F> void for_each_element(const F& f) const {
        std::apply([&](const auto&... sets) { (std::for_each(sets.begin(), sets.end(), f), ...); },
                   elements_);
    }

    PlacedCloth placed_;
    std::vector<Index> numbers_;
    std::tuple<std::vector<MembraneTriangle>, std::vector<BendElement>> elements_;
};

} // namespace

std::vector<ChangedPatch> find_changed_patches(const PlacedCloth& before,
                                               const PlacedCloth& after,
                                               const ClothChanges& changes,
                                               const Vec3& gravity) {
    Side now(after, lasting_numbers(before.x.size(), after.x.size(), changes));
    Side then(before, {});
    for_each_energy(after.cloth, [&](auto kind) {
        using Elements = typename decltype(kind)::type;
        if constexpr (Adaptive<Elements>) {
            const auto slots = Elements::changed_slots(after.cloth, changes);
            now.add<Elements>(slots);
            then.add<Elements>(slots_before(slots, Elements::slot_count(after.cloth),
                                            Elements::slot_count(before.cloth)));
        }
    });
    const std::size_t numbers = before.x.size() + after.x.size();
    DisjointSets sets(numbers);
    now.join(sets);
    then.join(sets);
    std::vector<double> gains(numbers, 0.0);
    now.add_energies(gravity, [&](Index v, double e) { gains[at(sets.find(v))] += e; });
    then.add_energies(gravity, [&](Index v, double e) { gains[at(sets.find(v))] -= e; });
    std::vector<Vec3> force_changes(numbers, Vec3::Zero());
    now.add_forces([&](Index v, const Vec3& f) { force_changes[at(v)] += f; });
    then.add_forces([&](Index v, const Vec3& f) { force_changes[at(v)] -= f; });

    // Sets without a changed triangle are of elements that only stand in another slot.
    std::vector<ChangedPatch> patches;
    std::vector<std::size_t> patch_of(numbers, 0); // by name of the set, from 1
    for (const Index v : now.vertices()) {
        const Index number = now.number(v);
        std::size_t& patch = patch_of[at(sets.find(number))];
        if (patch == 0) {
            patches.push_back({{}, gains[at(sets.find(number))]});
            patch = patches.size();
        }
        const bool is_old = at(number) < before.x.size();
        patches[patch - 1].vertices.push_back(
            {v, is_old ? before.cloth.rest_areas[at(number)] : 0.0, force_changes[at(number)]});
    }
    return patches;
}

} // namespace weft
