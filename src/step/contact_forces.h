#pragma once

#include "collide/contact.h"
#include "collide/contact_law.h"
#include "state/carrier_table.h"

#include "solver/block_matrix.h"

namespace weft {

/// How stiff a spring of contact is at each vertex (N/m, by World vertex): as the material itself,
/// so that the matrix is no worse conditioned; where bodies may be loaded by more than their
/// material is stiff, as the load asks for. Particles have none: what they carry touches.
std::vector<double> contact_stiffness(const World& world);

/// What contacts do inside the implicit solve. Each pushes along its normal and holds across it
/// (contact_law.h); both follow from where vertices end, so that for a given limit of friction
/// contact is the slope of a convex potential. What a contact does to a carried vertex it does to
/// the particles that carry it.
class ContactForces {
public:
    /// @param stiffness  of the springs, by vertex, N/m: as stiff as the cloth itself, so that the
    ///                   matrix is no worse conditioned
    explicit ContactForces(std::vector<double> stiffness, CarrierTable carriers = {})
        : stiffness_(std::move(stiffness)), carriers_(std::move(carriers)) {}

    /// Begins a substep, before any contact is added.
    /// @param start #V, positions at the start, m; must stay until the substep's end
    /// @param dt    s
    void start(std::span<const Vec3> start, double dt);

    /// Takes up what has been appended to the list since the last call. The list must stay where it
    /// is until the next call.
    void take(std::span<const Contact> contacts);

    bool empty() const { return springs_.empty(); }

    /// No obstacle takes part: what contacts do sums to zero.
    bool is_internal() const;

    /// Fits the limits of friction to how hard contacts push when vertices end at x (#V): static
    /// where a contact did not slide at the start of the substep, else kinetic.
    void fit_limits(std::span<const Vec3> x);

    /// Adds forces when vertices end at x (#V), N.
    void add_forces(std::span<const Vec3> x, std::span<Vec3> forces) const;

    /// Looks along x + alpha * motion (#V each, m); work_along is then the sum of force times
    /// motion there, J.
    void trace(std::span<const Vec3> x, std::span<const Vec3> motion);
    double work_along(double alpha) const;

    /// Counts the changes of the list: another number, other blocks.
    int revision() const { return revision_; }

    /// Blocks that contacts need in a matrix whose rows are those of the vertices.
    void list_blocks(std::span<const Index> row_of_vertex, std::vector<BlockEntry>& entries) const;

    /// Looks up where these blocks stand; those of vertices that are constrained are left out.
    void find_blocks(std::span<const Index> row_of_vertex,
                     std::span<const char> constrained,
                     const BlockMatrix& matrix);

    /// Adds scale * stiffness where vertices end at x to the blocks found.
    /// @param damping of friction that slides, see FrictionLaw
    void add_blocks(std::span<const Vec3> x, double scale, double damping, BlockMatrix& matrix);

    /// Writes what was carried, when vertices end at x, to the list given to take().
    void report(std::span<const Vec3> x, std::span<Contact> contacts) const;

    /// Of that the slips alone: vertices end at x after all. What a rigid body gave way is taken
    /// back at the end of a substep and must not count as slip, which would add up.
    void report_slips(std::span<const Vec3> x, std::span<Contact> contacts) const;

private:
    struct Spring {
        NormalLaw normal;
        FrictionLaw friction;
    };
    /// Where a contact stands when vertices end somewhere.
    struct Deflection {
        double approach; ///< nearer than the rest gap by this, m
        Vec3 tangential; ///< displacement of its friction spring, m
    };

    /// The share that a vertex which is solved for has in a contact.
    struct Term {
        Index vertex; ///< of World
        double weight;
    };

    std::span<const Term> terms(std::size_t contact) const;
    void add_terms(const Contact& contact);
    void add_term(std::size_t first, Index vertex, double weight);
    double stiffness_of(const Contact& contact) const;
    Deflection deflection(std::size_t contact, std::span<const Vec3> x) const;
    Vec3 relative(std::size_t contact, std::span<const Vec3> values) const;

    std::vector<double> stiffness_;
    CarrierTable carriers_;
    std::span<const Vec3> start_;
    double dt_ = 0.0;
    std::span<const Contact> contacts_;
    std::vector<Spring> springs_; ///< of each contact
    std::vector<Term> terms_;     ///< of all contacts, one after the other
    std::vector<std::size_t> terms_begin_{0}, pair_begin_{0};
    int revision_ = 0;
    std::vector<Index> term_blocks_; ///< of each contact's blocks, a row a term; k_no_index: none
    std::vector<Mat3> blocks_;       ///< of each contact
    std::vector<Deflection> deflections_,
        deflection_rates_; ///< by contact: at x, and along the motion
};

} // namespace weft
