#pragma once

#include "collide/contact_report.h"
#include "step/prepared.h"

#include <functional>
#include <memory>
#include <optional>

namespace weft {

/// Wall time of each stage, s.
struct StageSeconds {
    double forces = 0.0;   ///< element forces and stiffness
    double assembly = 0.0; ///< into the matrix
    double solve = 0.0;
    double contact_broad = 0.0, contact_proximity = 0.0, contact_impact = 0.0;
    double adapt = 0.0;         ///< the meshes, and what is made of them
    double matrix_update = 0.0; ///< part of adapt: forces and matrix taken to the new mesh
    double verify = 0.0;        ///< exact search for crossings, see verify_substeps()
};

/// What happened between two frames.
struct FrameReport {
    int substeps = 0;
    int retries = 0; ///< substeps thrown away and done again with half the length
    int cg_iterations = 0;
    double residual = 0.0; ///< greatest relative residual of a linear solve
    int refined = 0, coarsened = 0;
    double adaptation_energy = 0.0; ///< that adaptations gave all cloths; negative: took, J
    ContactReport
        contact;       ///< counts: greatest over the substeps; unresolved: at the end; gap: least
    int crossings = 0; ///< verified: pairs that cross after a substep, greatest of all
    /// Each unresolved pair once, as the last substep that found it did; sorted.
    std::vector<UnresolvedPair> problems{};
    /// Substeps that needed a stage of contact: met an impact, a zone, a scaled zone.
    int substeps_impacts = 0, substeps_zones = 0, substeps_scaled = 0;
    StageSeconds seconds;
};

/// Advances a world in time. Keeps matrices and trees between calls; the results depend on the
/// start and on the world given to each call alone.
class Stepper {
public:
    explicit Stepper(const Prepared& start);
    ~Stepper();
    Stepper(Stepper&&) noexcept;

    /// From now on, looks for crossings exactly after every substep.
    void verify_substeps(const World& world);

    /// From the world's frame to the next one. Throws Error (Diverged) when a substep fails at the
    /// floor of its length; the world then stands at its last good substep.
    /// @param should_stop asked between substeps; true makes it return early, with the world back
    ///                    at the frame it started from, and nullopt
    std::optional<FrameReport> advance_frame(World& world,
                                             const std::function<bool()>& should_stop);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace weft
