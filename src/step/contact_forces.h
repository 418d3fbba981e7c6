#pragma once

#include "collide/contact.h"
#include "collide/friction.h"
#include "solver/block_matrix.h"
#include "state/world.h"

namespace weft {

/// Stiffness of the springs of contact at each vertex, N/m. It is that of the material, so that the
/// matrix is no worse conditioned; where a load may be too much for that, the load sets it.
/// Particles of solids and rigid bodies have 0: only the surface that is embedded in them touches.
/// @returns #V, by World vertex
std::vector<double> contact_stiffness(const World& world);

/// Contact inside the implicit solve. Each contact has a normal and a friction spring
/// (NormalLaw, FrictionLaw). Both depend only on the end positions, so that with the friction
/// limits fixed contact is the gradient of a convex potential. Forces on an embedded vertex act on
/// the particles that it is embedded in.
class ContactForces {
public:
    /// @param stiffness  of the springs, by vertex, N/m: see contact_stiffness()
    explicit ContactForces(std::vector<double> stiffness, EmbeddingTable embeddings = {})
        : stiffness_(std::move(stiffness)), embeddings_(std::move(embeddings)) {}

    /// Begins a substep, before any contact is added.
    /// @param start #V, positions at the start, m; must stay until the substep's end
    /// @param dt    s
    void start(std::span<const Vec3> start, double dt);

    /// Adds the contacts that were appended to the list since the last call. The list must stay
    /// where it is until the next call.
    void take(std::span<const Contact> contacts);

    bool empty() const { return springs_.empty(); }

    /// True when no obstacle takes part, so that contact forces sum to zero.
    bool is_internal() const;

    /// Sets the limit of each contact's friction to coefficient times normal force at x (#V). The
    /// coefficient is the static one where the contact did not slide at the start of the substep,
    /// else the kinetic one.
    void fit_limits(std::span<const Vec3> x);

    /// Adds forces when vertices end at x (#V), N.
    void add_forces(std::span<const Vec3> x, std::span<Vec3> forces) const;

    /// Prepares a line search along x + alpha * motion (#V each, m). work_along then returns the
    /// sum of force times motion at alpha, J.
    void trace(std::span<const Vec3> x, std::span<const Vec3> motion);
    double work_along(double alpha) const;

    /// Counts the changes of the list: while it stays the same, so do the blocks.
    int revision() const { return revision_; }

    /// Lists the blocks that contacts need in a matrix whose rows are those of the vertices.
    void list_blocks(std::span<const Index> row_of_vertex, std::vector<BlockEntry>& entries) const;

    /// Looks up where these blocks stand in the matrix, but for those of constrained vertices.
    void find_blocks(std::span<const Index> row_of_vertex,
                     std::span<const char> constrained,
                     const BlockMatrix& matrix);

    /// Adds scale * stiffness where vertices end at x to the blocks found.
    /// @param damping of friction that slides, see FrictionLaw
    void add_blocks(std::span<const Vec3> x, double scale, double damping, BlockMatrix& matrix);

    /// Writes impulses, friction and slips at the end positions x to the list given to take().
    void report(std::span<const Vec3> x, std::span<Contact> contacts) const;

    /// Writes the slips alone once more, at other end positions x. Projecting a rigid body back to
    /// a rigid motion moves its particles; counted as slip, that would add up.
    void report_slips(std::span<const Vec3> x, std::span<Contact> contacts) const;

private:
    struct Spring {
        NormalLaw normal;
        FrictionLaw friction;
    };
    /// How far the springs of a contact are deflected.
    struct Deflection {
        double approach; ///< rest gap minus gap, m
        Vec3 tangential; ///< displacement of the friction spring, m
    };

    /// Weight of a vertex that is solved for in a contact.
    struct Term {
        Index vertex; ///< index in World
        double weight;
    };

    std::span<const Term> terms(std::size_t contact) const;
    void add_terms(const Contact& contact);
    void add_term(std::size_t first, Index vertex, double weight);
    double stiffness_of(const Contact& contact) const;
    Deflection deflection(std::size_t contact, std::span<const Vec3> x) const;
    Vec3 relative(std::size_t contact, std::span<const Vec3> values) const;

    std::vector<double> stiffness_;
    EmbeddingTable embeddings_;
    std::span<const Vec3> start_;
    double dt_ = 0.0;
    std::span<const Contact> contacts_;
    std::vector<Spring> springs_; ///< by contact
    std::vector<Term> terms_;     ///< all contacts, one after the other
    std::vector<std::size_t> terms_begin_{0}, pair_begin_{0};
    int revision_ = 0;
    std::vector<Index> term_blocks_; ///< blocks of each contact, a row a term; k_no_index: none
    std::vector<Mat3> blocks_;       ///< by contact
    std::vector<Deflection> deflections_,
        deflection_rates_; ///< by contact: at x, and along the motion
};

} // namespace weft
