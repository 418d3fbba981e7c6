#pragma once

#include "forces/cloth_forces.h"
#include "state/attachment.h"
#include "step/advance.h"

#include <vector>

namespace weft {

/// Stretch and shear over all triangles of cloth, weighted by their rest area. Where the model of
/// a cloth is made of edges, stretch is length over rest length of the edges that resist it, and
/// they divide its area between them. Edges of solids count half a square of the spacing each.
struct StrainStatistics {
    double stretch_min = 1.0;  ///< least principal stretch
    double stretch_mean = 1.0; ///< mean, 95th percentile and greatest of each triangle's greater
    double stretch_p95 = 1.0;  ///< principal stretch
    double stretch_max = 1.0;
    double shear_max_deg = 0.0; ///< greatest distance of weft and warp from a right angle
};

/// Energies and motion of everything that moves by forces.
struct MotionStatistics {
    double kinetic = 0.0, membrane = 0.0, bending = 0.0; ///< J; membrane includes edges of solids
    double gravity = 0.0;                                ///< J; 0 at the origin
    Vec3 centre_of_mass = Vec3::Zero();                  ///< m
    double max_speed = 0.0;                              ///< m/s
};

/// Numbers of one frame; a row of stats.csv.
struct FrameStatistics {
    int frame = 1;
    double time = 0.0;
    FrameReport report; ///< what advancing to this frame did; empty for the first
    std::size_t vertices = 0, triangles = 0;
    std::array<std::size_t, 9> levels{}; ///< triangles of each level of refinement
    int crossings = 0; ///< pairs that cross, by the exact test: greatest of the frame's own and of
                       ///< the substeps' where those were verified
    StrainStatistics strain;
    MotionStatistics motion;
    AttachmentReport attachments;
    double volume = 0.0;            ///< m^3, of all solids together
    std::size_t inverted_cells = 0; ///< in solids, see count_inverted_cells()
    double least_angle_deg = 60.0;  ///< least angle of a rest triangle of any cloth
    std::uint64_t state_hash = 0;
};

StrainStatistics measure_strain(const World& world);

/// Measures frames of one run; keeps the elements whose energies it sums.
class StatisticsCollector {
public:
    StatisticsCollector(const World& world, const SceneParams& scene);

    /// @param report    what advancing to this frame did
    /// @param crossings pairs of crossing triangles, see FrameStatistics
    FrameStatistics measure(const World& world, const FrameReport& report, int crossings);

private:
    MotionStatistics measure_motion(const World& world) const;

    void remesh(const World& world);

    Vec3 gravity_;
    double fps_;
    std::vector<Index> mesh_revisions_; ///< those that energies_ were made of
    std::vector<ElasticEnergy> energies_;
};

} // namespace weft
