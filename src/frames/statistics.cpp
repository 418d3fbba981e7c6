#include "frames/statistics.h"

#include "adapt/rest_split.h"
#include "base/parallel.h"
#include "frames/cache.h"
#include "frames/measures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {

namespace {

/// The stretch of one triangle or edge and the rest area that it stands for.
struct Weighted {
    double value, area;
};

/// Least value that at least `fraction` of the area does not exceed.
double percentile(std::vector<Weighted>& values, double fraction) {
    std::sort(values.begin(), values.end(),
              [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
    double total = 0.0;
    for (const Weighted& w : values) {
        total += w.area;
    }
    double sum = 0.0;
    for (const Weighted& w : values) {
        sum += w.area;
        if (sum >= fraction * total) {
            return w.value;
        }
    }
    return values.back().value;
}

std::array<std::size_t, 9> count_levels(const World& world) {
    std::array<std::size_t, 9> levels{};
    for (const Cloth& cloth : world.cloths) {
        for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
            ++levels[static_cast<std::size_t>(triangle_level(cloth, static_cast<Index>(t)))];
        }
    }
    return levels;
}

/// Adds objects to the statistics of all.
class StrainSums {
public:
    void add_triangles(const World& world, const Cloth& cloth) {
        const std::vector<StrainMeasures> measures = measure_triangles(world, cloth);
        const bool by_edges = has_edge_law(cloth.params.model);
        for (std::size_t t = 0; t < measures.size(); ++t) {
            const StrainMeasures& m = measures[t];
            statistics_.shear_max_deg = std::max(statistics_.shear_max_deg, std::abs(m.shear_deg));
            if (!by_edges) {
                add(m.stretch_max, cloth.rest[t].area);
                statistics_.stretch_min = std::min(statistics_.stretch_min, m.stretch_min);
            }
        }
        if (by_edges) {
            double area = 0.0;
            for (const RestTriangle& rest : cloth.rest) {
                area += rest.area;
            }
            const auto edges = edge_stretches(cloth.network, world.positions_of(cloth));
            for (const EdgeStretch& edge : edges) {
                add_edge(edge.stretch, area / static_cast<double>(edges.size()));
            }
        }
    }

    void add_solid(const World& world, const Solid& solid) {
        for (const double stretch : edge_stretches(world, solid)) {
            add_edge(stretch, 0.5 * solid.params.spacing * solid.params.spacing);
        }
    }

    StrainStatistics result() {
        if (stretches_.empty()) {
            return {.shear_max_deg = statistics_.shear_max_deg};
        }
        statistics_.stretch_mean = sum_ / area_;
        statistics_.stretch_p95 = percentile(stretches_, 0.95);
        return statistics_;
    }

private:
    void add_edge(double stretch, double area) {
        add(stretch, area);
        statistics_.stretch_min = std::min(statistics_.stretch_min, stretch);
    }

    void add(double stretch, double area) {
        stretches_.push_back({stretch, area});
        sum_ += stretch * area;
        area_ += area;
        statistics_.stretch_max = std::max(statistics_.stretch_max, stretch);
    }

    StrainStatistics statistics_{.stretch_min = std::numeric_limits<double>::infinity(),
                                 .stretch_max = 0.0};
    std::vector<Weighted> stretches_;
    double sum_ = 0.0, area_ = 0.0;
};

} // namespace

StrainStatistics measure_strain(const World& world) {
    StrainSums sums;
    for (const Cloth& cloth : world.cloths) {
        sums.add_triangles(world, cloth);
    }
    for (const Solid& solid : world.solids) {
        sums.add_solid(world, solid);
    }
    return sums.result();
}

StatisticsCollector::StatisticsCollector(const World& world, const SceneParams& scene)
    : gravity_(scene.gravity), fps_(scene.fps) {
    remesh(world);
}

void StatisticsCollector::remesh(const World& world) {
    if (!energies_.empty() && mesh_revisions_ == mesh_revisions(world)) {
        return;
    }
    mesh_revisions_ = mesh_revisions(world);
    energies_.clear();
    for (const Cloth& cloth : world.cloths) {
        energies_.emplace_back(cloth);
    }
    for (const Solid& solid : world.solids) {
        energies_.emplace_back(solid);
    }
}

MotionStatistics StatisticsCollector::measure_motion(const World& world) const {
    MotionStatistics motion;
    double mass = 0.0;
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        const double speed_squared = world.velocities[i].squaredNorm();
        motion.kinetic += 0.5 * world.masses[i] * speed_squared;
        motion.gravity -= world.masses[i] * gravity_.dot(world.positions[i]);
        motion.centre_of_mass += world.masses[i] * world.positions[i];
        motion.max_speed = std::max(motion.max_speed, speed_squared);
        mass += world.masses[i];
    }
    motion.max_speed = std::sqrt(motion.max_speed);
    if (mass > 0.0) {
        motion.centre_of_mass /= mass;
    }
    auto energies = energies_.begin(); // cloths, then solids
    const auto add_energies = [&](Index first) {
        const auto [stretching, bending] =
            (energies++)->measure(std::span(world.positions).subspan(at(first)));
        motion.membrane += stretching;
        motion.bending += bending;
    };
    for (const Cloth& cloth : world.cloths) {
        add_energies(cloth.first_vertex);
    }
    for (const Solid& solid : world.solids) {
        add_energies(solid.body.first_particle);
    }
    return motion;
}

FrameStatistics
StatisticsCollector::measure(const World& world, const FrameReport& report, int crossings) {
    remesh(world);
    double volume = 0.0;
    std::size_t inverted = 0;
    for (const Solid& solid : world.solids) {
        volume += body_volume(world, solid.body);
        inverted += count_inverted_cells(world, solid);
    }
    double least_angle = std::numbers::pi / 3.0;
    for (const Cloth& cloth : world.cloths) {
        least_angle = std::min(least_angle, least_rest_angle(cloth));
    }
    return {.frame = world.frame,
            .time = frame_time(world.frame, fps_),
            .report = report,
            .vertices = world.vertex_count(),
            .triangles = world.triangle_count(),
            .levels = count_levels(world),
            .crossings = crossings,
            .strain = measure_strain(world),
            .motion = measure_motion(world),
            .attachments = measure_attachments(world),
            .volume = volume,
            .inverted_cells = inverted,
            .least_angle_deg = least_angle * 180.0 / std::numbers::pi,
            .state_hash = state_hash(world)};
}

} // namespace weft
