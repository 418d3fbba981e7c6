#include "remesh/relax_after_remesh.h"

#include "base/line_search.h"

#include <Eigen/Cholesky>

#include <algorithm>

namespace weft {

namespace {

/// Rounds over the vertices of a patch. A gain that is left after these is held by vertices that
/// may not move; more rounds would make folds that the motion has not made yet.
constexpr int k_rounds = 6;

/// Step lengths that are tried for a shift, each half the one before: 1 to 1/8.
constexpr int k_tries = 4;

/// Fraction of a gain that may be left: the last of it takes as many rounds as all before.
constexpr double k_left_fraction = 0.1;

/// A vertex stays where it is when its force changed by less than this fraction of the largest
/// change in its patch. Smaller: twice as many vertices move for a few percent of the gain.
constexpr double k_least_change = 0.05;

/// A vertex is settled when its shift took less than this fraction of the mean gain per vertex.
constexpr double k_least_fraction = 0.01;

/// One vertex of a patch.
struct RelaxingVertex {
    VertexEnergy around;
    Vec3 start;                 ///< position before the relaxation, m
    Vec3 weight = Vec3::Zero(); ///< N
    Vec3 target = Vec3::Zero(); ///< elastic force and weight at the end, N
    bool is_settled = false;
};

/// Acceleration by elastic forces and weight before the adaptation, m/s^2.
/// @param force  elastic, now, N
Vec3 acceleration_before(const RelaxationContext& context,
                         const ChangedVertex& vertex,
                         const Vec3& force) {
    const double mass = context.cloth.params.fabric.area_density * vertex.area_before;
    return (force - vertex.force_change) / mass + context.gravity;
}

/// Accelerations before the adaptation, for the vertices of a patch that existed then.
class OldAccelerations {
public:
    void add(Index v, const Vec3& acceleration) {
        vertices_.push_back(v);
        accelerations_.push_back(acceleration);
    }

    /// Acceleration of a vertex; for a new one the mean of those in its triangles, zero without
    /// any.
    Vec3 at_vertex(const Cloth& cloth, const VertexEnergy& vertex) const {
        if (const Vec3* own = of(vertex.vertex())) {
            return *own;
        }
        Vec3 sum = Vec3::Zero();
        int count = 0;
        for (const Index t : vertex.star()) {
            for (const Index corner : cloth.triangles[at(t)]) {
                if (const Vec3* other = of(corner)) {
                    sum += *other;
                    ++count;
                }
            }
        }
        return count > 0 ? Vec3(sum / count) : sum;
    }

private:
    const Vec3* of(Index v) const {
        const auto position = std::lower_bound(vertices_.begin(), vertices_.end(), v);
        return position == vertices_.end() || *position != v
                   ? nullptr
                   : &accelerations_[static_cast<std::size_t>(position - vertices_.begin())];
    }

    std::vector<Index> vertices_; ///< ascending
    std::vector<Vec3> accelerations_;
};

std::vector<RelaxingVertex> relaxing_vertices(const RelaxationContext& context,
                                              const ChangedPatch& patch) {
    double most = 0.0;
    for (const ChangedVertex& changed : patch.vertices) {
        most = std::max(most, changed.force_change.norm());
    }
    std::vector<RelaxingVertex> all;
    OldAccelerations accelerations;
    for (const ChangedVertex& changed : patch.vertices) {
        if (changed.force_change.norm() < k_least_change * most) {
            continue;
        }
        VertexEnergy around(context.cloth, context.stars, changed.vertex, context.bends);
        if (changed.area_before > 0.0) {
            accelerations.add(changed.vertex,
                              acceleration_before(context, changed, around.force(context.x)));
        }
        if (context.may_move[at(changed.vertex)] != 0) {
            all.push_back({std::move(around), context.x[at(changed.vertex)]});
        }
    }
    for (RelaxingVertex& one : all) {
        const double mass = context.cloth.params.fabric.area_density *
                            context.cloth.rest_areas[at(one.around.vertex())];
        one.weight = mass * context.gravity;
        one.target = mass * accelerations.at_vertex(context.cloth, one.around);
    }
    return all;
}

/// Moves a vertex towards where its elastic force and weight are the target. Returns the decrease
/// of energy, J.
double relax_vertex(RelaxingVertex& one, double farthest, std::span<Vec3> x) {
    Vec3& position = x[at(one.around.vertex())];
    const Vec3 old = position;
    const double membrane = one.around.membrane(x);
    Mat3 stiffness;
    const Vec3 force = one.around.force(x, &stiffness) + one.weight - one.target;
    const Vec3 step = stiffness.ldlt().solve(force);
    double decrease = 0.0;
    backtrack(1.0, k_tries, [&](double alpha) {
        Vec3 displacement = old + alpha * step - one.start;
        if (displacement.norm() > farthest) {
            displacement *= farthest / displacement.norm();
        }
        const Vec3 shift = one.start + displacement - old;
        const double bending = one.around.bending_change(x, shift);
        position = one.start + displacement;
        const double trial = membrane - one.around.membrane(x) - bending + one.weight.dot(shift);
        if (trial > one.target.dot(shift)) {
            decrease = trial;
            return true;
        }
        position = old;
        return false;
    });
    return decrease;
}

} // namespace

double relax_after_remesh(const RelaxationContext& context,
                          const ChangedPatch& patch,
                          std::vector<Index>& shifted) {
    std::vector<RelaxingVertex> vertices = relaxing_vertices(context, patch);
    const double enough = k_left_fraction * patch.gain;
    const double least = k_least_fraction * patch.gain / static_cast<double>(patch.vertices.size());
    double gain = patch.gain;
    for (int round = 0; round < k_rounds && gain > enough; ++round) {
        for (std::size_t i = 0; i < vertices.size() && gain > enough; ++i) {
            if (!vertices[i].is_settled) {
                const double decrease = relax_vertex(vertices[i], context.farthest, context.x);
                vertices[i].is_settled = std::abs(decrease) < least;
                gain -= decrease;
            }
        }
    }
    for (const RelaxingVertex& one : vertices) {
        if (context.x[at(one.around.vertex())] != one.start) {
            shifted.push_back(one.around.vertex());
        }
    }
    return gain;
}

} // namespace weft
