#include "remesh/absorb_gain.h"

#include <Eigen/Cholesky>

#include <algorithm>

namespace weft {

namespace {

/// Rounds over the vertices of a patch. What has not given way after these is held by vertices that
/// may not move, and more rounds make folds that the motion has not made yet.
constexpr int k_rounds = 6;

/// Halvings of a shift that raises the energy.
constexpr int k_halvings = 3;

/// Share of a gain that may be left: the last of it takes as many rounds as all before.
constexpr double k_left_share = 0.1;

/// A vertex whose forces changed by less than this share of what the most did in its patch stays.
/// Smaller: twice as many vertices move for a few percent of the gain.
constexpr double k_least_change = 0.05;

/// A vertex that has given less than this share of what each would have to give for the whole gain
/// is left alone from then on.
constexpr double k_least_share = 0.01;

/// One vertex of a patch.
struct Yielding {
    VertexEnergy around;
    Vec3 start;                 ///< where it was, m
    Vec3 weight = Vec3::Zero(); ///< N
    Vec3 target = Vec3::Zero(); ///< elastic force and weight that it is to have, N
    bool is_settled = false;
};

/// Acceleration by elastic forces and weight before the adaptation, m/s^2.
/// @param force  elastic, now, N
Vec3 acceleration_before(const YieldingCloth& yielding,
                         const ChangedVertex& vertex,
                         const Vec3& force) {
    const double mass = yielding.cloth.params.fabric.area_density * vertex.area_before;
    return (force - vertex.force_change) / mass + yielding.gravity;
}

/// Accelerations before the adaptation of those vertices of a patch that were there.
class OldAccelerations {
public:
    void add(Index v, const Vec3& acceleration) {
        vertices_.push_back(v);
        accelerations_.push_back(acceleration);
    }

    /// Of a vertex, or of a new one the mean of those in its triangles; zero where there is none.
    Vec3 around(const Cloth& cloth, const VertexEnergy& vertex) const {
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
        const auto place = std::lower_bound(vertices_.begin(), vertices_.end(), v);
        return place == vertices_.end() || *place != v
                   ? nullptr
                   : &accelerations_[static_cast<std::size_t>(place - vertices_.begin())];
    }

    std::vector<Index> vertices_; ///< ascending
    std::vector<Vec3> accelerations_;
};

std::vector<Yielding> yielding_vertices(const YieldingCloth& yielding, const ChangedPatch& patch) {
    double most = 0.0;
    for (const ChangedVertex& changed : patch.vertices) {
        most = std::max(most, changed.force_change.norm());
    }
    std::vector<Yielding> all;
    OldAccelerations accelerations;
    for (const ChangedVertex& changed : patch.vertices) {
        if (changed.force_change.norm() < k_least_change * most) {
            continue;
        }
        VertexEnergy around(yielding.cloth, yielding.stars, changed.vertex, yielding.bends);
        if (changed.area_before > 0.0) {
            accelerations.add(changed.vertex,
                              acceleration_before(yielding, changed, around.force(yielding.x)));
        }
        if (yielding.may_move[at(changed.vertex)] != 0) {
            all.push_back({std::move(around), yielding.x[at(changed.vertex)]});
        }
    }
    for (Yielding& one : all) {
        const double mass = yielding.cloth.params.fabric.area_density *
                            yielding.cloth.rest_areas[at(one.around.vertex())];
        one.weight = mass * yielding.gravity;
        one.target = mass * accelerations.around(yielding.cloth, one.around);
    }
    return all;
}

/// Moves a vertex towards where its forces are those that it is to have. Returns by how much the
/// energy fell, J.
double give_way(Yielding& one, double farthest, std::span<Vec3> x) {
    Vec3& place = x[at(one.around.vertex())];
    const Vec3 old = place;
    const double membrane = one.around.membrane(x);
    Mat3 stiffness;
    const Vec3 force = one.around.force(x, &stiffness) + one.weight - one.target;
    Vec3 step = stiffness.ldlt().solve(force);
    for (int k = 0; k <= k_halvings; ++k, step *= 0.5) {
        Vec3 way = old + step - one.start;
        if (way.norm() > farthest) {
            way *= farthest / way.norm();
        }
        const Vec3 shift = one.start + way - old;
        const double bending = one.around.bending_change(x, shift);
        place = one.start + way;
        const double fall = membrane - one.around.membrane(x) - bending + one.weight.dot(shift);
        if (fall > one.target.dot(shift)) {
            return fall;
        }
        place = old;
    }
    return 0.0;
}

} // namespace

double
absorb_gain(const YieldingCloth& yielding, const ChangedPatch& patch, std::vector<Index>& shifted) {
    std::vector<Yielding> vertices = yielding_vertices(yielding, patch);
    const double enough = k_left_share * patch.gain;
    const double least = k_least_share * patch.gain / static_cast<double>(patch.vertices.size());
    double gain = patch.gain;
    for (int round = 0; round < k_rounds && gain > enough; ++round) {
        for (std::size_t i = 0; i < vertices.size() && gain > enough; ++i) {
            if (!vertices[i].is_settled) {
                const double fall = give_way(vertices[i], yielding.farthest, yielding.x);
                vertices[i].is_settled = std::abs(fall) < least;
                gain -= fall;
            }
        }
    }
    for (const Yielding& one : vertices) {
        if (yielding.x[at(one.around.vertex())] != one.start) {
            shifted.push_back(one.around.vertex());
        }
    }
    return gain;
}

} // namespace weft
