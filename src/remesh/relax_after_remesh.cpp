#include "remesh/relax_after_remesh.h"

#include "base/disjoint_sets.h"
#include "base/line_search.h"
#include "forces/cloth_forces.h"

#include <Eigen/Cholesky>

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

namespace {

/// Rounds over the vertices of a patch. A gain that is left after these is held by vertices that
/// may not move; more rounds would make folds that the motion has not made yet.
constexpr int k_rounds = 6;

/// Step lengths that are tried for a shift, each half the one before: 1 to 1/8.
constexpr int k_tries = 4;

/// Fraction of a gain that may be left: the last of it takes as many rounds as all before.
constexpr double k_left_fraction = 0.1;

/// A vertex stays where it is when its force changed by less than this fraction of the largest
/// change in its patch. Smaller: twice as many vertices move for a few percent of the gain.
constexpr double k_least_change = 0.05;

/// A vertex is settled when its shift took less than this fraction of the mean gain per vertex.
constexpr double k_least_fraction = 0.01;

/// One vertex of a patch.
struct RelaxingVertex {
    VertexEnergy around;
    Vec3 start;                 ///< position before the relaxation, m
    Vec3 weight = Vec3::Zero(); ///< N
    Vec3 target = Vec3::Zero(); ///< elastic force and weight at the end, N
    bool is_settled = false;
};

/// Acceleration by elastic forces and weight before the adaptation, m/s^2.
/// @param force  elastic, now, N
Vec3 acceleration_before(const RelaxationContext& context,
                         const ChangedVertex& vertex,
                         const Vec3& force) {
    const double mass = context.cloth.params.fabric.area_density * vertex.area_before;
    return (force - vertex.force_change) / mass + context.gravity;
}

/// Accelerations before the adaptation, for the vertices of a patch that existed then.
class OldAccelerations {
public:
    void add(Index v, const Vec3& acceleration) {
        vertices_.push_back(v);
        accelerations_.push_back(acceleration);
    }

    /// Acceleration of a vertex; for a new one the mean of those in its triangles, zero without
    /// any.
    Vec3 at_vertex(const Cloth& cloth, const VertexEnergy& vertex) const {
        if (const Vec3* own = of(vertex.vertex())) {
            return *own;
        }
        Vec3 sum = Vec3::Zero();
        int count = 0;
        for (const Index t : vertex.star()) {
            for (const Index corner : cloth.triangles[at(t)]) {
                if (const Vec3* other = of(corner)) {
                    sum += *other;
                    ++count;
                }
            }
        }
        return count > 0 ? Vec3(sum / count) : sum;
    }

private:
    const Vec3* of(Index v) const {
        const auto position = std::lower_bound(vertices_.begin(), vertices_.end(), v);
        return position == vertices_.end() || *position != v
                   ? nullptr
                   : &accelerations_[static_cast<std::size_t>(position - vertices_.begin())];
    }

    std::vector<Index> vertices_; ///< ascending
    std::vector<Vec3> accelerations_;
};

std::vector<RelaxingVertex> relaxing_vertices(const RelaxationContext& context,
                                              const ChangedPatch& patch) {
    double most = 0.0;
    for (const ChangedVertex& changed : patch.vertices) {
        most = std::max(most, changed.force_change.norm());
    }
    std::vector<RelaxingVertex> all;
    OldAccelerations accelerations;
    for (const ChangedVertex& changed : patch.vertices) {
        if (changed.force_change.norm() < k_least_change * most) {
            continue;
        }
        VertexEnergy around(context.cloth, context.stars, changed.vertex, context.bends);
        if (changed.area_before > 0.0) {
            accelerations.add(changed.vertex,
                              acceleration_before(context, changed, around.force(context.x)));
        }
        if (context.may_move[at(changed.vertex)] != 0) {
            all.push_back({std::move(around), context.x[at(changed.vertex)]});
        }
    }
    for (RelaxingVertex& one : all) {
        const double mass = context.cloth.params.fabric.area_density *
                            context.cloth.rest_areas[at(one.around.vertex())];
        one.weight = mass * context.gravity;
        one.target = mass * accelerations.at_vertex(context.cloth, one.around);
    }
    return all;
}

/// Moves a vertex towards where its elastic force and weight are the target. Returns the decrease
/// of energy, J.
double relax_vertex(RelaxingVertex& one, double farthest, std::span<Vec3> x) {
    Vec3& position = x[at(one.around.vertex())];
    const Vec3 old = position;
    const double membrane = one.around.membrane(x);
    Mat3 stiffness;
    const Vec3 force = one.around.force(x, &stiffness) + one.weight - one.target;
    const Vec3 step = stiffness.ldlt().solve(force);
    double decrease = 0.0;
    backtrack(1.0, k_tries, [&](double alpha) {
        Vec3 displacement = old + alpha * step - one.start;
        if (displacement.norm() > farthest) {
            displacement *= farthest / displacement.norm();
        }
        const Vec3 shift = one.start + displacement - old;
        const double bending = one.around.bending_change(x, shift);
        position = one.start + displacement;
        const double trial = membrane - one.around.membrane(x) - bending + one.weight.dot(shift);
        if (trial > one.target.dot(shift)) {
            decrease = trial;
            return true;
        }
        position = old;
        return false;
    });
    return decrease;
}

} // namespace

double relax_after_remesh(const RelaxationContext& context,
                          const ChangedPatch& patch,
                          std::vector<Index>& shifted) {
    std::vector<RelaxingVertex> vertices = relaxing_vertices(context, patch);
    const double enough = k_left_fraction * patch.gain;
    const double least = k_least_fraction * patch.gain / static_cast<double>(patch.vertices.size());
    double gain = patch.gain;
    for (int round = 0; round < k_rounds && gain > enough; ++round) {
        for (std::size_t i = 0; i < vertices.size() && gain > enough; ++i) {
            if (!vertices[i].is_settled) {
                const double decrease = relax_vertex(vertices[i], context.farthest, context.x);
                vertices[i].is_settled = std::abs(decrease) < least;
                gain -= decrease;
            }
        }
    }
    for (const RelaxingVertex& one : vertices) {
        if (context.x[at(one.around.vertex())] != one.start) {
            shifted.push_back(one.around.vertex());
        }
    }
    return gain;
}

} // namespace weft
