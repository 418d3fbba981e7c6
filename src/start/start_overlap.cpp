#include "start/start_overlap.h"

#include "base/error.h"
#include "collide/crossings.h"
#include "collide/untangle.h"
#include "geometry/inset.h"
#include "state/obstacle.h"
#include "state/pin.h"
#include "step/advance.h"

#include <algorithm>

namespace weft {

namespace {

/// What growing took.
struct GrowReport {
    double deepest_inset = 0.0;    ///< by which a vertex of an obstacle started shrunken, m
    int rounds = 0;                ///< rounds of untangling what shrinking left crossing
    int substeps = 0;              ///< substeps of the pre-roll
    double max_displacement = 0.0; ///< that a vertex of cloth moved, m
};

/// Depth that is tried first, m, and by what it grows from one try to the next. Smaller: obstacles
/// are drawn in less deep than they need not be, after more tries.
constexpr double k_first_depth = 1e-3;
constexpr double k_deeper = 1.5;

/// Most that an obstacle is drawn in, as a fraction of its diagonal: 0.19 m for a body.
constexpr double k_deepest_fraction = 0.1;

/// Length of a substep of the pre-roll, s: what makes cloth follow and not swing.
constexpr double k_substep = 0.01;

/// Growth in one substep, as a fraction of the least contact thickness. Larger: more work left to
/// continuous detection; smaller: a longer pre-roll.
constexpr double k_growth_fraction = 0.5;

/// Bounds of the substeps of growth, and those after it in which contacts find their distance.
constexpr int k_least_substeps = 10;
constexpr int k_most_substeps = 400;
constexpr int k_settling_substeps = 10;

/// An obstacle during the pre-roll: its full size, and how it is drawn in.
struct Grown {
    std::vector<Vec3> full; ///< m, world
    Inset inset;            ///< empty until something crosses the obstacle
    double depth = 0.0;     ///< m

    Vec3 place(std::size_t vertex, double fraction) const {
        return full[vertex] + inset.displacement(vertex, fraction * depth);
    }
    double deepest() const {
        double deepest = 0.0;
        for (const double limit : inset.limit) {
            deepest = std::max(deepest, std::min(depth, limit));
        }
        return deepest;
    }
    bool can_go_deeper() const {
        return inset.limit.empty() ||
               depth < *std::max_element(inset.limit.begin(), inset.limit.end());
    }
};

/// The world of the pre-roll: the meshes stay as imported, nothing holds or joins vertices, nothing
/// moves, and obstacles stand still. Solids and rigid bodies take part: they have contact with the
/// cloth that is carried, and an obstacle that they cross gives way and pushes them out as it does
/// cloth.
World still_world(const World& world) {
    World still = world;
    for (Cloth& cloth : still.cloths) {
        cloth.params.adapt.levels = 0;
    }
    still.pins.clear();
    still.pin_groups.clear();
    still.attachments.clear();
    still.attached_pairs.clear();
    still.attached_states.clear();
    std::fill(still.velocities.begin(), still.velocities.end(), Vec3::Zero());
    for (Obstacle& obstacle : still.obstacles) {
        std::vector<Vec3> places(obstacle.mesh.positions.size());
        obstacle_positions(obstacle, 0.0, places);
        obstacle.mesh.positions = places;
        obstacle.origin.setZero();
        obstacle.params.motion.clear();
        obstacle.deformation = nullptr;
    }
    return still;
}

/// One pre-roll from the drawn-in obstacles to their size.
class PreRoll {
public:
    PreRoll(World& world, const Scene& scene)
        : world_(world), still_(still_world(world)), contact_(scene.contact), scene_(scene.scene),
          grown_(world.obstacles.size()) {
        scene_.fps = 1.0 / k_substep;
        scene_.substeps = 1;
        scene_.integrator = Integrator::Euler;
        scene_.gravity.setZero();
        scene_.wind.setZero();
        for (std::size_t o = 0; o < grown_.size(); ++o) {
            grown_[o].full = still_.obstacles[o].mesh.positions;
        }
    }

    std::optional<GrowReport> run(const std::function<bool()>& should_stop) {
        if (contact_.self) {
            report_.rounds += untangle(still_, {.obstacles = false}).rounds;
        }
        draw_in();
        report_.rounds += untangle(still_, {.cloth = contact_.self}).rounds;
        const int growing = let_grow();
        Stepper stepper({still_, scene_, contact_});
        for (; report_.substeps < growing + k_settling_substeps; ++report_.substeps) {
            if (!stepper.advance_frame(still_, should_stop)) {
                return std::nullopt;
            }
            std::fill(still_.velocities.begin(), still_.velocities.end(), Vec3::Zero());
        }
        for (std::size_t v = 0; v < world_.vertex_count(); ++v) {
            const double way = (still_.positions[v] - world_.positions[v]).norm();
            report_.max_displacement = std::max(report_.max_displacement, way);
        }
        world_.positions = still_.positions;
        return report_;
    }

private:
    /// Deeper and deeper, until cloth crosses no obstacle that can still give way.
    void draw_in() {
        WorldCrossings crossings(still_, false);
        std::vector<char> crossed;
        do {
            crossed.assign(grown_.size(), 0);
            for (const UnresolvedPair& pair : crossings.find(still_, 0.0)) {
                if (pair.objects[1].is_obstacle()) {
                    crossed[at(pair.objects[1].index)] = 1;
                }
            }
            for (std::size_t o = 0; o < grown_.size(); ++o) {
                crossed[o] = crossed[o] && grown_[o].can_go_deeper();
                if (crossed[o]) {
                    draw_in_deeper(o);
                }
            }
        } while (std::find(crossed.begin(), crossed.end(), 1) != crossed.end());
    }

    void draw_in_deeper(std::size_t o) {
        Grown& grown = grown_[o];
        TriangleMesh& mesh = still_.obstacles[o].mesh;
        if (grown.inset.limit.empty()) {
            Eigen::AlignedBox3d box;
            for (const Vec3& x : grown.full) {
                box.extend(x);
            }
            grown.inset =
                find_inset(grown.full, mesh.triangles, k_deepest_fraction * box.diagonal().norm());
        }
        grown.depth = grown.depth == 0.0 ? k_first_depth : k_deeper * grown.depth;
        for (std::size_t v = 0; v < grown.full.size(); ++v) {
            mesh.positions[v] = grown.place(v, 1.0);
        }
    }

    /// Makes the drawn-in obstacles grow from t = 0 on; returns the substeps that this takes.
    int let_grow() {
        double thickness = std::numeric_limits<double>::infinity();
        for (const Cloth& cloth : still_.cloths) {
            thickness = std::min(thickness, cloth.params.fabric.thickness);
        }
        for (const Grown& grown : grown_) {
            report_.deepest_inset = std::max(report_.deepest_inset, grown.deepest());
        }
        const double wanted = std::ceil(report_.deepest_inset / (k_growth_fraction * thickness));
        const int substeps =
            static_cast<int>(std::clamp<double>(wanted, k_least_substeps, k_most_substeps));
        const double duration = k_substep * substeps;
        for (std::size_t o = 0; o < grown_.size(); ++o) {
            const Grown& grown = grown_[o];
            if (grown.depth > 0.0) {
                still_.obstacles[o].deformation = std::make_shared<Deformation>(
                    grown.full.size(), 0, [&grown, duration](double t, std::span<Vec3> places) {
                        const double fraction = std::max(1.0 - t / duration, 0.0);
                        for (std::size_t v = 0; v < places.size(); ++v) {
                            places[v] = fraction > 0.0 ? grown.place(v, fraction) : grown.full[v];
                        }
                    });
            }
        }
        return substeps;
    }

    World& world_;
    World still_;
    ContactParams contact_;
    SceneParams scene_;
    std::vector<Grown> grown_;
    GrowReport report_;
};

/// Takes cloth out of obstacles by letting these grow into it: each obstacle that something crosses
/// is drawn in along its normals as deep as it takes until nothing crosses it (what then still does
/// is untangled), and grows back to its size over a simulated pre-roll in which contact pushes the
/// cloth out. Meanwhile time, the obstacles' own motion, gravity and wind stand still, pins let go
/// and each substep starts from rest: the cloth is carried, not thrown, and nothing falls before
/// the scene begins. Cloth that crosses cloth is untangled first.
///
/// Changes world.positions alone, which may still cross something when contact did not get through.
/// Nothing when should_stop returned true; the world is then to be thrown away.
std::optional<GrowReport>
grow_obstacles(World& world, const Scene& scene, const std::function<bool()>& should_stop) {
    return PreRoll(world, scene).run(should_stop);
}

/// Pairs named in a message; more would not be read.
constexpr std::size_t k_named = 3;

void refuse(const World& world, std::span<const UnresolvedPair> pairs, const char* remedy) {
    if (!pairs.empty()) {
        fail_input("{} at the start: {}", describe_crossings(world, pairs), remedy);
    }
}

StartOverlapReport start_untangled(World& world, const ContactParams& contact) {
    const UntangleReport untangled = untangle(world, {.cloth = contact.self});
    return {.rounds = untangled.rounds, .max_displacement = untangled.max_displacement};
}

} // namespace

std::vector<UnresolvedPair> crossings_of_contact(const World& world, const ContactParams& contact) {
    if (!contact.enabled) {
        return {};
    }
    std::vector<UnresolvedPair> pairs =
        find_crossings(world, std::numeric_limits<std::size_t>::max());
    if (!contact.self) {
        std::erase_if(pairs,
                      [](const UnresolvedPair& pair) { return !pair.objects[1].is_obstacle(); });
    }
    return pairs;
}

std::string describe_crossings(const World& world, std::span<const UnresolvedPair> pairs) {
    std::string text;
    for (const UnresolvedPair& pair : pairs.first(std::min(pairs.size(), k_named))) {
        text +=
            fmt::format("{}{}: triangle {} crosses {} triangle {} at ({:.4g}, {:.4g}, {:.4g}) m",
                        text.empty() ? "" : "; ", object_name(world, pair.objects[0]),
                        pair.triangles[0], object_name(world, pair.objects[1]), pair.triangles[1],
                        pair.place.x(), pair.place.y(), pair.place.z());
    }
    return fmt::format("{}; {} pair{} cross{}", text, pairs.size(), pairs.size() == 1 ? "" : "s",
                       pairs.size() == 1 ? "es" : "");
}

std::optional<StartOverlapReport>
cure_start_overlap(World& world, const Scene& scene, const std::function<bool()>& should_stop) {
    const std::vector<UnresolvedPair> before = crossings_of_contact(world, scene.contact);
    StartOverlapReport report;
    if (before.empty()) {
        return report;
    }
    switch (scene.contact.start_overlap) {
    case StartOverlap::Error:
        refuse(world, before,
               "must be apart; contact.start_overlap = \"untangle\" moves cloth apart, "
               "\"grow\" lets obstacles grow into it; weft inspect lists the pairs");
        break;
    case StartOverlap::Untangle:
        report = start_untangled(world, scene.contact);
        refuse(world, crossings_of_contact(world, scene.contact),
               "untangling could not part them: move the cloth or try start_overlap = \"grow\"");
        break;
    case StartOverlap::Grow: {
        const auto grown = grow_obstacles(world, scene, should_stop);
        if (!grown) {
            return std::nullopt;
        }
        report = {.rounds = grown->rounds,
                  .max_displacement = grown->max_displacement,
                  .deepest_inset = grown->deepest_inset,
                  .preroll_substeps = grown->substeps};
        refuse(world, crossings_of_contact(world, scene.contact),
               "growing could not part them: move the cloth or try start_overlap = \"untangle\"");
        break;
    }
    }
    hold_pins_here(world);
    report.pairs_before = before.size();
    world.previous_positions = world.positions;
    return report;
}

} // namespace weft
