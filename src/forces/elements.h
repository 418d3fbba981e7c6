#pragma once

#include "base/eigen.h"
#include "base/parallel.h"
#include "state/cloth.h"
#include "state/refinement.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <vector>

/// What every set of force elements has in common, so that one assembler serves them all.
///
/// A set is the elements of one kind on one object, whose own vertex indices it uses. It derives
/// from ElementLoops and describes one element:
///
///     double energy_of(e, x) const               J; where the force has a potential
///     ElementTerms terms_of(e, x, v, scales) const
///                                                force and system blocks
///     std::array<Vec3, k_nodes> force_of(e, x, v) const
///                                                N; where that is cheaper than terms_of
///
/// The set of a cloth that adapts also has
///
///     static std::size_t slot_count(cloth)       how many elements the cloth has now
///     static std::vector<Index> changed_slots(cloth, changes)
///                                                those that an adaptation changed, ascending
///     static Element element(cloth, slot)        one of them by itself, with count, node(a),
///                                                has(a), empty(), energy(x), for_each_force(x, f)
///     std::vector<Index> remesh(cloth, changes)  makes the set that of the cloth as it is now;
///                                                returns changed_slots
///
/// (only energies have the first three). Bending with a constant matrix has its own loops:
/// forces/constant_bending.h. Which sets a cloth has: forces/cloth_forces.h.
namespace weft {

/// Blocks of the upper triangle of an element with n vertices.
constexpr int block_count(int n) {
    return n * (n + 1) / 2;
}

/// Place of block (a, b), a <= b, among the upper triangle's blocks stored row by row.
constexpr std::size_t block_index(int n, int a, int b) {
    return static_cast<std::size_t>(a * n - a * (a - 1) / 2 + (b - a));
}

/// Energy, force and stiffness of one element of N vertices.
template <int N, int Blocks = block_count(N)> struct ElementTerms {
    double energy = 0.0;       ///< elastic, J
    std::array<Vec3, N> force; ///< on each vertex, damping included, N
    std::array<Mat3, at(Blocks)>
        stiffness; ///< upper triangle row by row: (0,0), (0,1) .. (0,N-1), (1,1) ..; N/m
};

/// The factors that an implicit integrator gives stiffness and damping in its system: the blocks
/// written are stiffness * K + damping * D with K = -df/dx made positive semidefinite and
/// D = -df/dv. Implicit Euler: {dt^2, dt}.
struct SystemScales {
    double stiffness = 1.0;
    double damping = 0.0;
};

/// The loops over the elements of a set of type Derived, N vertices each. They allocate nothing and
/// give the same bits for any number of threads.
///
/// @tparam Blocks  blocks written for each element. 1 for an element of two vertices whose forces
///                 depend on the difference between them: its one block stands for that of each
///                 vertex with itself, and its negative for that between the two.
template <class Derived, int N, int Blocks = block_count(N)> class ElementLoops {
public:
    static constexpr int k_nodes = N;
    static constexpr bool k_is_difference = Blocks != block_count(N);

    std::size_t size() const { return nodes_.size() / N; }

    /// N vertices an element. k_no_index: no vertex there; its force and blocks are zero.
    std::span<const Index> nodes() const { return nodes_; }

    /// Energy at positions x (#V of the object, m), J.
    double energy(std::span<const Vec3> x) const {
        return parallel_sum(size(), [&](std::size_t e) { return self().energy_of(e, x); });
    }

    /// Forces on the nodes, N each element, N.
    void
    forces(std::span<const Vec3> x, std::span<const Vec3> v, std::span<Vec3> element_forces) const {
        assert(element_forces.size() == nodes_.size());
        parallel_for(size(), [&](std::size_t e) {
            const std::array<Vec3, N> force = self().force_of(e, x, v);
            std::copy(force.begin(), force.end(), &element_forces[N * e]);
        });
    }

    /// The same forces, and `Blocks` system blocks each element.
    void evaluate(std::span<const Vec3> x,
                  std::span<const Vec3> v,
                  SystemScales scales,
                  std::span<Vec3> element_forces,
                  std::span<Mat3> element_blocks) const {
        assert(element_forces.size() == nodes_.size() && element_blocks.size() == Blocks * size());
        parallel_for(size(), [&](std::size_t e) {
            const auto terms = self().terms_of(e, x, v, scales);
            std::copy(terms.force.begin(), terms.force.end(), &element_forces[N * e]);
            std::copy(terms.stiffness.begin(), terms.stiffness.end(), &element_blocks[Blocks * e]);
        });
    }

    std::array<Vec3, N>
    force_of(std::size_t e, std::span<const Vec3> x, std::span<const Vec3> v) const {
        return self().terms_of(e, x, v, {}).force;
    }

protected:
    /// What an element's vertices have in `values`; none may be missing.
    std::array<Vec3, N> gather(std::size_t e, std::span<const Vec3> values) const {
        std::array<Vec3, N> gathered;
        for (std::size_t a = 0; a < N; ++a) {
            gathered[a] = values[at(nodes_[N * e + a])];
        }
        return gathered;
    }

    /// Makes the nodes those of the cloth's triangles.
    void set_triangles(const Cloth& cloth) requires(N == 3) {
        nodes_.clear();
        nodes_.reserve(3 * cloth.triangles.size());
        for (const Triangle& t : cloth.triangles) {
            nodes_.insert(nodes_.end(), t.begin(), t.end());
        }
    }

    /// The same where they are those of the cloth before the changes.
    void update_triangles(const Cloth& cloth, const ClothChanges& changes) requires(N == 3) {
        nodes_.resize(3 * cloth.triangles.size());
        for (const Index t : changes.triangles) {
            std::copy(cloth.triangles[at(t)].begin(), cloth.triangles[at(t)].end(),
                      &nodes_[3 * at(t)]);
        }
    }

    std::vector<Index> nodes_;

private:
    const Derived& self() const { return static_cast<const Derived&>(*this); }
};

} // namespace weft
