#include "remesh/changed_patches.h"

#include "base/disjoint_sets.h"
#include "forces/membrane.h"

#include <algorithm>
#include <iterator>
#include <numeric>

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

/// What an adaptation changed of a cloth, as it was or as it is.
class Side {
public:
    /// @param bends    slots of changed elements of bending
    /// @param numbers  that vertices keep; empty: their slots
    Side(const PlacedCloth& placed,
         std::vector<Index> triangles,
         const std::vector<Index>& bends,
         std::vector<Index> numbers)
        : placed_(placed), triangles_(std::move(triangles)), numbers_(std::move(numbers)) {
        for (const Index slot : bends) {
            bends_.push_back(bend_element(placed_.cloth, slot));
            if (bends_.back().empty()) {
                bends_.pop_back();
            }
        }
        for (const Index t : triangles_) {
            const Triangle& corners = placed_.cloth.triangles[at(t)];
            vertices_.insert(vertices_.end(), corners.begin(), corners.end());
        }
        std::sort(vertices_.begin(), vertices_.end());
        vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    }

    /// Of the triangles, ascending.
    const std::vector<Index>& vertices() const { return vertices_; }
    Index number(Index v) const { return numbers_.empty() ? v : numbers_[at(v)]; }

    /// Joins what shares an element.
    void join(DisjointSets& sets) const {
        for (const Index t : triangles_) {
            const Triangle& corners = placed_.cloth.triangles[at(t)];
            sets.join(number(corners[0]), number(corners[1]));
            sets.join(number(corners[0]), number(corners[2]));
        }
        for (const BendElement& bend : bends_) {
            for (int a = 1; a < bend.count; ++a) {
                if (bend.has(a)) {
                    sets.join(number(bend.node(0)), number(bend.node(a)));
                }
            }
        }
    }

    /// Calls add(number, energy) for all that has energy, each with a vertex of its own.
    template <typename Add> void for_each_energy(const Vec3& gravity, const Add& add) const {
        const Cloth& cloth = placed_.cloth;
        const MembraneStiffness stiffness = membrane_stiffness(cloth.params.fabric);
        for (const Index t : triangles_) {
            add(number(cloth.triangles[at(t)][0]),
                membrane_energy(corners(t), cloth.rest[at(t)], stiffness));
        }
        for (const BendElement& bend : bends_) {
            add(number(bend.node(0)), bend.energy(placed_.x));
        }
        for (const Index v : vertices_) { // the sum of the masses is the same before and after
            const double mass = cloth.params.fabric.area_density * cloth.rest_areas[at(v)];
            add(number(v), -mass * gravity.dot(placed_.x[at(v)] - placed_.x[0]));
        }
    }

    /// Calls add(number, force) for the elastic forces of all elements.
    template <typename Add> void for_each_force(const Add& add) const {
        const Cloth& cloth = placed_.cloth;
        const MembraneStiffness stiffness = membrane_stiffness(cloth.params.fabric);
        const Corners still{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
        for (const Index t : triangles_) {
            const Corners forces =
                membrane_forces(corners(t), still, cloth.rest[at(t)], stiffness, 0.0);
            for (std::size_t k = 0; k < 3; ++k) {
                add(number(cloth.triangles[at(t)][k]), forces[k]);
            }
        }
        for (const BendElement& bend : bends_) {
            for (int a = 0; a < bend.count; ++a) {
                if (bend.has(a)) {
                    add(number(bend.node(a)), Vec3(-bend.gradient(a, placed_.x)));
                }
            }
        }
    }

private:
    Corners corners(Index t) const {
        const Triangle& v = placed_.cloth.triangles[at(t)];
        return {placed_.x[at(v[0])], placed_.x[at(v[1])], placed_.x[at(v[2])]};
    }

    PlacedCloth placed_;
    std::vector<Index> triangles_, numbers_, vertices_;
    std::vector<BendElement> bends_;
};

} // namespace

std::vector<ChangedPatch> find_changed_patches(const PlacedCloth& before,
                                               const PlacedCloth& after,
                                               const ClothChanges& changes,
                                               const Vec3& gravity) {
    const std::vector<Index> bends = changed_bends(after.cloth, changes);
    const Side now(after, changes.triangles, bends,
                   lasting_numbers(before.x.size(), after.x.size(), changes));
    const Side then(before,
                    slots_before(changes.triangles, after.cloth.triangles.size(),
                                 before.cloth.triangles.size()),
                    slots_before(bends, bend_slots(after.cloth), bend_slots(before.cloth)), {});
    const std::size_t numbers = before.x.size() + after.x.size();
    DisjointSets sets(numbers);
    now.join(sets);
    then.join(sets);
    std::vector<double> gains(numbers, 0.0);
    now.for_each_energy(gravity, [&](Index v, double e) { gains[at(sets.find(v))] += e; });
    then.for_each_energy(gravity, [&](Index v, double e) { gains[at(sets.find(v))] -= e; });
    std::vector<Vec3> force_changes(numbers, Vec3::Zero());
    now.for_each_force([&](Index v, const Vec3& f) { force_changes[at(v)] += f; });
    then.for_each_force([&](Index v, const Vec3& f) { force_changes[at(v)] -= f; });

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
