/// compare_runs REFERENCE RUN [EVERY]: how far the cloth of a run is from that of another run of
/// the same scene with a finer mesh, at every EVERY-th frame (1 when left out) that both have.
///
/// Measured at the reference's vertices, each weighted by its share of the flat pattern's area:
/// - to the same material point of the run, found by u v; where the pattern lies on itself
///   (garments of several charts) the nearest of the places with this u v; vertices outside are
///   left out, and so are triangles over a cut of the pattern, whose corners have the u v of
///   different sides;
/// - to the nearest point of the run's surface.
/// Prints a table: size (diagonal of the cloth's box at the first frame, m), rms and greatest of
/// both distances (m).

#include "base/error.h"
#include "frames/cache.h"
#include "geometry/box_tree.h"
#include "geometry/distance.h"
#include "geometry/extent.h"
#include "scene/scene_reader.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

namespace weft {

namespace {

/// How far a vertex may lie outside of a triangle of the pattern, in weights: u v are floats.
constexpr double k_outside = 1e-4;
constexpr double k_margin = 1e-5; ///< the same in m, of the search

/// A triangle whose pattern is longer than the cloth's by more than this much of what it is on
/// average lies over a cut. Charts differ in scale by less than twice, cuts by ten times and more.
constexpr double k_cut = 3.0;

CachedRun open_run(const std::filesystem::path& folder) {
    return CachedRun(folder, read_scene(folder / "scene.resolved.toml"));
}

Vec3 flat(const Vec2f& u) {
    return {u.x(), u.y(), 0.0};
}

/// All cloth of a frame as one surface, with its flat pattern.
struct Surface {
    std::vector<Vec3> positions; ///< m
    std::vector<Vec3> pattern;   ///< u v 0, m
    std::vector<Triangle> triangles;
    std::vector<Triangle> uncut; ///< those of them that lie in the pattern
};

double longest_edge(const std::vector<Vec3>& points, const Triangle& t) {
    const auto edge = [&](std::size_t a, std::size_t b) {
        return (points[at(t[a])] - points[at(t[b])]).norm();
    };
    return std::max({edge(0, 1), edge(1, 2), edge(2, 0)});
}

/// The triangles that do not lie over a cut of the pattern.
std::vector<Triangle> uncut_triangles(const Surface& surface) {
    std::vector<double> scales;
    for (const Triangle& t : surface.triangles) {
        scales.push_back(longest_edge(surface.pattern, t) / longest_edge(surface.positions, t));
    }
    std::vector<double> sorted = scales;
    const auto middle = sorted.begin() + static_cast<long>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    std::vector<Triangle> uncut;
    for (std::size_t i = 0; i < scales.size(); ++i) {
        if (scales[i] < k_cut * *middle) {
            uncut.push_back(surface.triangles[i]);
        }
    }
    return uncut;
}

Surface surface_of(const Frame& frame) {
    Surface surface;
    for (const FrameObject& object : frame.objects) {
        if (object.kind != ObjectKind::Cloth) {
            continue;
        }
        const auto first = static_cast<Index>(surface.positions.size());
        for (std::size_t v = 0; v < object.positions.size(); ++v) {
            surface.positions.push_back(object.positions[v].cast<double>());
            surface.pattern.push_back(flat(object.material_positions[v]));
        }
        for (const Triangle& t : object.triangles) {
            surface.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
        }
    }
    surface.uncut = uncut_triangles(surface);
    return surface;
}

BoxTree tree_of(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
    std::vector<Box> boxes;
    for (const Triangle& t : triangles) {
        const Vec3& last = points[at(t[2])];
        boxes.push_back(unite(segment_box(points[at(t[0])], points[at(t[1])], k_margin),
                              segment_box(last, last, k_margin)));
    }
    return BoxTree(boxes);
}

double pattern_area(const Surface& surface, const Triangle& t) {
    const auto& u = surface.pattern;
    return 0.5 * (u[at(t[1])] - u[at(t[0])]).cross(u[at(t[2])] - u[at(t[0])]).norm();
}

std::vector<double> vertex_areas(const Surface& surface) {
    std::vector<double> areas(surface.positions.size(), 0.0);
    for (const Triangle& t : surface.uncut) {
        for (const Index v : t) {
            areas[at(v)] += pattern_area(surface, t) / 3.0;
        }
    }
    return areas;
}

/// Weights of a point of the plane in a triangle there; some are negative when it lies outside.
Vec3 weights_in_plane(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const double area = (b - a).cross(c - a).z();
    const double wb = (p - a).cross(c - a).z() / area;
    const double wc = (b - a).cross(p - a).z() / area;
    return {1.0 - wb - wc, wb, wc};
}

/// Distances of places to a surface, which is searched in space and in its flat pattern.
class Distances {
public:
    explicit Distances(const Surface& surface)
        : surface_(surface), in_space_(tree_of(surface.positions, surface.triangles)),
          in_pattern_(tree_of(surface.pattern, surface.uncut)) {}

    /// To the place of material point u; empty: it is not in the pattern.
    std::optional<double> to_material(const Vec3& p, const Vec3& u) const {
        std::optional<double> least;
        in_pattern_.query(segment_box(u, u, 0.0), [&](Index i) {
            const Triangle& t = surface_.uncut[at(i)];
            const auto corner = [&](std::size_t k) { return surface_.pattern[at(t[k])]; };
            const Vec3 w = weights_in_plane(u, corner(0), corner(1), corner(2));
            if (w.minCoeff() > -k_outside) {
                const double distance = (p - place(t, w)).norm();
                least = std::min(least.value_or(distance), distance);
            }
        });
        return least;
    }

    double to_surface(const Vec3& p) const {
        double limit = std::numeric_limits<double>::infinity();
        in_space_.near(p, limit, [&](Index i) {
            const Triangle& t = surface_.triangles[at(i)];
            const auto corner = [&](std::size_t k) { return surface_.positions[at(t[k])]; };
            const Vec3 w = closest_weights_on_triangle(p, corner(0), corner(1), corner(2));
            limit = std::min(limit, (p - place(t, w)).squaredNorm());
        });
        return std::sqrt(limit);
    }

private:
    Vec3 place(const Triangle& t, const Vec3& w) const {
        const auto& x = surface_.positions;
        return w[0] * x[at(t[0])] + w[1] * x[at(t[1])] + w[2] * x[at(t[2])];
    }

    const Surface& surface_;
    BoxTree in_space_, in_pattern_;
};

/// Root of the weighted mean square, and the greatest.
struct Spread {
    double squares = 0.0, weights = 0.0, greatest = 0.0;

    void add(double distance, double weight) {
        squares += weight * distance * distance;
        weights += weight;
        greatest = std::max(greatest, distance);
    }
    double rms() const { return std::sqrt(squares / weights); }
};

void compare(int number, double size, const Surface& reference, const Surface& run) {
    const Distances distances(run);
    const std::vector<double> areas = vertex_areas(reference);
    Spread material, surface;
    for (std::size_t v = 0; v < reference.positions.size(); ++v) {
        const Vec3& p = reference.positions[v];
        if (const auto distance = distances.to_material(p, reference.pattern[v])) {
            material.add(*distance, areas[v]);
        }
        surface.add(distances.to_surface(p), areas[v]);
    }
    fmt::print("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", number, size, material.rms(),
               material.greatest, surface.rms(), surface.greatest);
}

double size_of(const Surface& surface) {
    Box3 box;
    for (const Vec3& x : surface.positions) {
        box.extend(x);
    }
    return box.diagonal().norm();
}

int compare_runs(const std::filesystem::path& reference_folder,
                 const std::filesystem::path& run_folder,
                 int every) {
    const CachedRun reference = open_run(reference_folder);
    const CachedRun run = open_run(run_folder);
    const std::vector<int> known = reference.frames();
    const double size = size_of(surface_of(reference.read(known.front())));
    fmt::print("frame,size_m,rms_m,max_m,surface_rms_m,surface_max_m\n");
    for (const int number : run.frames()) {
        if ((number - 1) % every == 0 && std::binary_search(known.begin(), known.end(), number)) {
            compare(number, size, surface_of(reference.read(number)), surface_of(run.read(number)));
        }
    }
    return 0;
}

} // namespace

} // namespace weft

int main(int count, char** arguments) {
    if (count < 3 || count > 4) {
        fmt::print(stderr, "compare_runs REFERENCE RUN [EVERY]\n");
        return 2;
    }
    try {
        return weft::compare_runs(arguments[1], arguments[2],
                                  count > 3 ? std::max(1, std::atoi(arguments[3])) : 1);
    } catch (const std::exception& e) {
        fmt::print(stderr, "compare_runs: {}\n", e.what());
        return 1;
    }
}
