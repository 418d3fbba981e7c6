#include "geometry/inset.h"

#include "base/parallel.h"
#include "geometry/mesh_measure.h"
#include "geometry/nearest_surface.h"

namespace weft {

namespace {

/// Fraction of the thickness that may be drawn in from one side: opposite sides must not meet.
constexpr double k_thickness_fraction = 0.45;

/// Most by which the limit may change along the surface, m/m. Larger: steps in the drawn-in
/// surface.
constexpr double k_steepest = 0.5;

/// Least cosine between a triangle's normals before and after.
constexpr double k_least_cosine = 0.3;

/// Times that the limits around triangles that would turn over are halved.
constexpr int k_halvings = 10;

/// No limit may be more than k_steepest times the way above that of another vertex.
void smooth(std::span<const Vec3> positions,
            std::span<const Triangle> triangles,
            std::vector<double>& limit) {
    std::vector<double> start(limit.size());
    for (std::size_t v = 0; v < limit.size(); ++v) {
        start[v] = limit[v] / k_steepest;
    }
    const MeshDistances reached = mesh_distances(positions, triangles, start);
    for (std::size_t v = 0; v < limit.size(); ++v) {
        limit[v] = k_steepest * reached.cost[v];
    }
}

/// Halves the limits of triangles that turn over when drawn in by theirs. False: none does.
bool ease(std::span<const Vec3> positions, std::span<const Triangle> triangles, Inset& inset) {
    std::vector<char> turned(positions.size(), 0);
    bool any = false;
    for (const Triangle& t : triangles) {
        const auto drawn_in = [&](std::size_t k) {
            const std::size_t v = at(t[k]);
            return Vec3(positions[v] + inset.limit[v] * inset.inward[v]);
        };
        const Vec3 before =
            triangle_normal(positions[at(t[0])], positions[at(t[1])], positions[at(t[2])]);
        const Vec3 after = triangle_normal(drawn_in(0), drawn_in(1), drawn_in(2));
        if (!before.isZero() && before.dot(after) < k_least_cosine) {
            any = true;
            for (const Index v : t) {
                turned[at(v)] = 1;
            }
        }
    }
    for (std::size_t v = 0; v < turned.size(); ++v) {
        inset.limit[v] *= turned[v] ? 0.5 : 1.0;
    }
    return any;
}

} // namespace

Inset find_inset(std::span<const Vec3> positions,
                 std::span<const Triangle> triangles,
                 double greatest) {
    const NearestSurface surface(std::vector<Vec3>(positions.begin(), positions.end()), triangles);
    Inset inset;
    inset.inward.resize(positions.size());
    inset.limit.resize(positions.size());
    parallel_for(
        positions.size(),
        [&](std::size_t v) {
            const Vec3& normal = surface.vertex_normal(static_cast<Index>(v));
            inset.inward[v] = -normal;
            const double reach = greatest / k_thickness_fraction;
            const auto opposite = surface.first_hit(positions[v], -normal, reach);
            inset.limit[v] = k_thickness_fraction * opposite.value_or(reach);
        },
        32);
    smooth(positions, triangles, inset.limit);
    for (int i = 0; i < k_halvings && ease(positions, triangles, inset); ++i) {
        smooth(positions, triangles, inset.limit);
    }
    return inset;
}

} // namespace weft
