#pragma once

#include "collide/contact.h"
#include "step/block_matrix.h"

namespace weft {

/// What resting contacts with obstacles do inside the implicit solve: a stiff one-sided spring
/// along the normal from the contact thickness inwards, and a damper across that stands for Coulomb
/// friction: stiff where friction can hold, else as strong as makes its force Coulomb's at the slip
/// found. Both are revised once a rough solution is known; a damper never drives, whatever is
/// found.
///
/// Without it the solve lets cloth sink in for a substep and gives away the tension that presses it
/// on: friction then finds too little to hold with, and draped cloth creeps off.
class ContactForces {
public:
    /// @param stiffness  of the springs, by vertex, N/m: as stiff as the cloth itself, so that the
    ///                   matrix is no worse conditioned
    explicit ContactForces(std::vector<double> stiffness) : stiffness_(std::move(stiffness)) {}

    /// Chooses what acts during the substep that starts now.
    /// @param start             #V, positions at the start, m
    /// @param velocities        #V, at the start, m/s
    /// @param free_velocities   #V, expected at the end without contact, m/s
    void start(std::span<const RestingContact> contacts,
               std::span<const Vec3> start,
               std::span<const Vec3> velocities,
               std::span<const Vec3> free_velocities,
               double dt);

    bool acts() const { return !active_.empty(); }

    /// Adds forces at positions x and velocities v (#V of the world), N.
    void add_forces(std::span<const Vec3> x, std::span<const Vec3> v, std::span<Vec3> forces) const;

    /// Adds beta^2 * stiffness + beta * damping to the matrix, whose rows are those of the
    /// vertices.
    void add_blocks(double beta, std::span<const Index> row_of_vertex, BlockMatrix& matrix) const;

    /// Lets go of springs that pull at (x, v) and fits dampers to Coulomb's cone there; false when
    /// there was nothing to change.
    bool revise(std::span<const Vec3> x, std::span<const Vec3> v);

    /// Writes what was carried over the substep, at its end state, to the contacts given to start.
    void report(std::span<const Vec3> x,
                std::span<const Vec3> v,
                std::span<RestingContact> contacts) const;

private:
    struct Active {
        Index contact; ///< of the list given to start
        RestingContact geometry;
        double stiffness; ///< N/m
        double hold;      ///< damping across of a contact that holds, N s/m
        double damping;   ///< across now, N s/m
    };

    double push(const Active& active, std::span<const Vec3> x) const;
    Vec3 drag(const Active& active, std::span<const Vec3> v) const;

    std::vector<double> stiffness_;
    std::vector<Active> active_;
    std::vector<Vec3> start_;
    double dt_ = 0.0;
};

} // namespace weft
