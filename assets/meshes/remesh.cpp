#include "remesh.h"

#include <Eigen/Dense>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace weft {
namespace {

constexpr Triangle k_removed{-1, -1, -1};

/// The patch with the triangles of each vertex, kept up to date by three edits.
class Remesher {
public:
    Remesher(Patch& patch,
             const Field& surface,
             const std::vector<Field>& limits,
             const Field& edge_length)
        : patch_(patch), surface_(surface), limits_(limits), edge_length_(edge_length),
          triangles_of_(patch.vertices.size()) {
        for (size_t t = 0; t < patch.triangles.size(); ++t)
            for (const VertexIndex v : patch.triangles[t])
                around(v).push_back(static_cast<int>(t));
    }

    void run(const RemeshParams& params) {
        for (int pass = 0; pass < params.passes; ++pass) {
            split_long_edges();
            collapse_short_edges();
            flip_edges([this](const Quad& quad) { return valence_gain(quad) > 0; });
            smooth();
        }
        for (int pass = 0; pass < params.settle_passes; ++pass) {
            flip_edges([this](const Quad& quad) { return is_not_delaunay(quad); });
            smooth();
        }
        drop_removed_triangles();
    }

private:
    /// The edge a-b with the triangles (a, b, c) and (b, a, d) beside it.
    struct Quad {
        VertexIndex a, b, c, d;
        int left, right; ///< the triangles
    };

    Vec3& x(VertexIndex v) { return patch_.vertices[static_cast<size_t>(v)]; }
    unsigned& curves(VertexIndex v) { return patch_.curves[static_cast<size_t>(v)]; }
    Triangle& triangle(int t) { return patch_.triangles[static_cast<size_t>(t)]; }
    int& panel(int t) { return patch_.panels[static_cast<size_t>(t)]; }
    std::vector<int>& around(VertexIndex v) { return triangles_of_[static_cast<size_t>(v)]; }
    double length(VertexIndex a, VertexIndex b) { return (x(b) - x(a)).norm(); }

    double wanted_length(VertexIndex a, VertexIndex b) { return edge_length_(0.5 * (x(a) + x(b))); }

    static bool has(const Triangle& triangle, VertexIndex v) {
        return std::find(triangle.begin(), triangle.end(), v) != triangle.end();
    }

    static VertexIndex third(const Triangle& triangle, VertexIndex a, VertexIndex b) {
        return triangle[0] + triangle[1] + triangle[2] - a - b;
    }

    std::vector<int> triangles_at(VertexIndex a, VertexIndex b) {
        std::vector<int> result;
        for (const int t : around(a))
            if (has(triangle(t), b))
                result.push_back(t);
        return result;
    }

    bool is_feature(const std::vector<int>& beside) {
        return beside.size() != 2 || panel(beside[0]) != panel(beside[1]);
    }

    std::vector<VertexIndex> neighbours(VertexIndex v) {
        std::vector<VertexIndex> result;
        for (const int t : around(v))
            for (const VertexIndex w : triangle(t))
                if (w != v && std::find(result.begin(), result.end(), w) == result.end())
                    result.push_back(w);
        return result;
    }

    std::vector<VertexIndex> feature_neighbours(VertexIndex v) {
        std::vector<VertexIndex> result;
        for (const VertexIndex w : neighbours(v))
            if (is_feature(triangles_at(v, w)))
                result.push_back(w);
        return result;
    }

    /// 0 inside, 1 on a border or seam, 2 where such curves meet.
    int rank(VertexIndex v) {
        const size_t count = feature_neighbours(v).size();
        if (count == 0)
            return 0;
        return count != 2 || std::popcount(curves(v)) > 1 ? 2 : 1;
    }

    std::vector<std::pair<VertexIndex, VertexIndex>> edges() {
        std::vector<std::pair<VertexIndex, VertexIndex>> result;
        for (const Triangle& tri : patch_.triangles)
            for (size_t k = 0; k < 3 && tri != k_removed; ++k)
                result.emplace_back(std::minmax(tri[k], tri[(k + 1) % 3]));
        std::sort(result.begin(), result.end());
        result.erase(std::unique(result.begin(), result.end()), result.end());
        return result;
    }

    Vec3 normal(const Triangle& tri) {
        return (x(tri[1]) - x(tri[0])).cross(x(tri[2]) - x(tri[0]));
    }

    /// Least height over longest side; 0.87 when equilateral.
    double shape(const Triangle& tri) {
        const double longest =
            std::max({length(tri[0], tri[1]), length(tri[1], tri[2]), length(tri[2], tri[0])});
        return normal(tri).norm() / (longest * longest);
    }

    void split_long_edges() {
        for (const auto& [a, b] : edges()) {
            const std::vector<int> beside = triangles_at(a, b);
            if (beside.empty())
                continue;
            const bool is_shortcut = !is_feature(beside) && (curves(a) & curves(b)) != 0;
            if (is_shortcut || length(a, b) > 4.0 / 3.0 * wanted_length(a, b))
                split(a, b, beside);
        }
    }

    void split(VertexIndex a, VertexIndex b, const std::vector<int>& beside) {
        const auto middle = static_cast<VertexIndex>(patch_.vertices.size());
        const unsigned bits = is_feature(beside) ? curves(a) & curves(b) : 0U;
        const Vec3 position = 0.5 * (x(a) + x(b));
        patch_.vertices.push_back(position);
        patch_.curves.push_back(bits);
        triangles_of_.emplace_back();
        for (const int t : beside) {
            const VertexIndex c = third(triangle(t), a, b);
            Triangle other = triangle(t);
            std::replace(other.begin(), other.end(), a, middle);
            std::replace(triangle(t).begin(), triangle(t).end(), b, middle);
            const auto added = static_cast<int>(patch_.triangles.size());
            patch_.triangles.push_back(other);
            patch_.panels.push_back(panel(t));
            std::replace(around(b).begin(), around(b).end(), t, added);
            around(c).push_back(added);
            around(middle).push_back(t);
            around(middle).push_back(added);
        }
        project(middle);
    }

    void collapse_short_edges() {
        for (const auto& [a, b] : edges()) {
            if (triangles_at(a, b).empty() || length(a, b) > 0.8 * wanted_length(a, b))
                continue;
            const int rank_a = rank(a);
            const int rank_b = rank(b);
            if (rank_a <= rank_b ? !try_collapse(a, b, rank_a) : !try_collapse(b, a, rank_b))
                if (rank_a == rank_b)
                    try_collapse(b, a, rank_b);
        }
    }

    /// Moves `gone` onto `kept` if the mesh stays manifold and no triangle turns over.
    bool try_collapse(VertexIndex gone, VertexIndex kept, int rank_gone) {
        const std::vector<int> beside = triangles_at(gone, kept);
        if (rank_gone == 2 || (rank_gone == 1 && !is_feature(beside)))
            return false;
        const std::vector<VertexIndex> ring = neighbours(gone);
        const std::vector<VertexIndex> kept_ring = neighbours(kept);
        size_t common = 0;
        for (const VertexIndex v : ring) {
            const bool is_common =
                std::find(kept_ring.begin(), kept_ring.end(), v) != kept_ring.end();
            common += is_common ? 1 : 0;
            if (v == kept || is_common)
                continue;
            if (length(v, kept) > 4.0 / 3.0 * wanted_length(v, kept))
                return false;
            if ((curves(v) & curves(kept)) != 0 && (curves(v) & curves(gone)) == 0)
                return false;
        }
        if (common != beside.size())
            return false;
        for (const int t : around(gone)) {
            if (has(triangle(t), kept))
                continue;
            Triangle moved = triangle(t);
            std::replace(moved.begin(), moved.end(), gone, kept);
            // A sliver's own normal says nothing, so it may not veto.
            if (shape(triangle(t)) > 0.05 &&
                normal(moved).normalized().dot(normal(triangle(t)).normalized()) < 0.5)
                return false;
        }
        collapse(gone, kept);
        return true;
    }

    void collapse(VertexIndex gone, VertexIndex kept) {
        for (const int t : std::vector<int>(around(gone))) {
            if (has(triangle(t), kept)) {
                for (const VertexIndex v : triangle(t))
                    std::erase(around(v), t);
                triangle(t) = k_removed;
            } else {
                std::replace(triangle(t).begin(), triangle(t).end(), gone, kept);
                around(kept).push_back(t);
            }
        }
        around(gone).clear();
    }

    template <class Wish> void flip_edges(const Wish& is_wished) {
        for (const auto& [a, b] : edges()) {
            const std::vector<int> beside = triangles_at(a, b);
            if (beside.size() != 2 || is_feature(beside))
                continue;
            const bool in_order = follows(triangle(beside[0]), a, b);
            const int left = in_order ? beside[0] : beside[1];
            const int right = in_order ? beside[1] : beside[0];
            const Quad quad{a,    b,    third(triangle(left), a, b), third(triangle(right), a, b),
                            left, right};
            if (is_wished(quad) && is_flippable(quad))
                flip(quad);
        }
    }

    static bool follows(const Triangle& tri, VertexIndex a, VertexIndex b) {
        for (size_t k = 0; k < 3; ++k)
            if (tri[k] == a && tri[(k + 1) % 3] == b)
                return true;
        return false;
    }

    bool is_flippable(const Quad& quad) {
        if (!triangles_at(quad.c, quad.d).empty() || (curves(quad.c) & curves(quad.d)) != 0)
            return false;
        const Vec3 before = normal(triangle(quad.left)) + normal(triangle(quad.right));
        const Vec3 first = normal({quad.a, quad.d, quad.c});
        const Vec3 second = normal({quad.d, quad.b, quad.c});
        return first.normalized().dot(before.normalized()) > 0.7 &&
               second.normalized().dot(before.normalized()) > 0.7;
    }

    void flip(const Quad& quad) {
        triangle(quad.left) = {quad.a, quad.d, quad.c};
        triangle(quad.right) = {quad.d, quad.b, quad.c};
        std::erase(around(quad.b), quad.left);
        std::erase(around(quad.a), quad.right);
        around(quad.d).push_back(quad.left);
        around(quad.c).push_back(quad.right);
    }

    int valence_gain(const Quad& quad) {
        const auto error = [this](VertexIndex v, int change) {
            const int wanted = rank(v) == 0 ? 6 : 4;
            const int deviation = static_cast<int>(neighbours(v).size()) + change - wanted;
            return deviation * deviation;
        };
        return error(quad.a, 0) + error(quad.b, 0) + error(quad.c, 0) + error(quad.d, 0) -
               error(quad.a, -1) - error(quad.b, -1) - error(quad.c, 1) - error(quad.d, 1);
    }

    bool is_not_delaunay(const Quad& quad) {
        const auto angle = [this, &quad](VertexIndex apex) {
            const Vec3 e = x(quad.a) - x(apex);
            const Vec3 f = x(quad.b) - x(apex);
            return std::atan2(e.cross(f).norm(), e.dot(f));
        };
        return angle(quad.c) + angle(quad.d) > 3.1416 + 0.02;
    }

    void smooth() {
        for (size_t i = 0; i < patch_.vertices.size(); ++i) {
            const auto v = static_cast<VertexIndex>(i);
            if (around(v).empty())
                continue;
            const std::vector<VertexIndex> features = feature_neighbours(v);
            if (features.empty())
                x(v) += 0.7 * (ring_centre(v) - x(v));
            else if (features.size() == 2 && std::popcount(curves(v)) < 2)
                x(v) += 0.5 * (0.5 * (x(features[0]) + x(features[1])) - x(v));
            project(v);
        }
    }

    /// Mean of the centroids around v, weighted by area over wanted area.
    Vec3 ring_centre(VertexIndex v) {
        Vec3 sum = Vec3::Zero();
        double weights = 0.0;
        for (const int t : around(v)) {
            const Triangle& tri = triangle(t);
            const Vec3 centroid = (x(tri[0]) + x(tri[1]) + x(tri[2])) / 3.0;
            const double wanted = edge_length_(centroid);
            const double weight = normal(tri).norm() / (wanted * wanted);
            sum += weight * centroid;
            weights += weight;
        }
        return weights > 0.0 ? Vec3(sum / weights) : x(v);
    }

    /// Newton steps of least length onto the surface and the limits of v.
    void project(VertexIndex v) {
        std::vector<const Field*> fields{&surface_};
        for (size_t k = 0; k < limits_.size(); ++k)
            if ((curves(v) >> k & 1U) != 0)
                fields.push_back(&limits_[k]);
        const auto count = static_cast<Eigen::Index>(fields.size());
        for (int step = 0; step < 8; ++step) {
            Eigen::VectorXd values(count);
            for (Eigen::Index i = 0; i < count; ++i)
                values[i] = (*fields[static_cast<size_t>(i)])(x(v));
            if (values.cwiseAbs().maxCoeff() < 1e-7)
                return;
            Eigen::MatrixXd jacobian(count, 3);
            for (Eigen::Index i = 0; i < count; ++i)
                jacobian.row(i) = gradient(*fields[static_cast<size_t>(i)], x(v)).transpose();
            Vec3 move = -jacobian.completeOrthogonalDecomposition().solve(values);
            const double limit = 0.5 * edge_length_(x(v));
            if (move.norm() > limit)
                move *= limit / move.norm();
            x(v) += move;
        }
    }

    void drop_removed_triangles() {
        Patch result = patch_;
        result.triangles.clear();
        result.panels.clear();
        for (size_t t = 0; t < patch_.triangles.size(); ++t) {
            if (patch_.triangles[t] == k_removed)
                continue;
            result.triangles.push_back(patch_.triangles[t]);
            result.panels.push_back(patch_.panels[t]);
        }
        patch_ = largest_part(result);
    }

    Patch& patch_;
    const Field& surface_;
    const std::vector<Field>& limits_;
    const Field& edge_length_;
    std::vector<std::vector<int>> triangles_of_; ///< per vertex
};

} // namespace

void remesh(Patch& patch,
            const Field& surface,
            const std::vector<Field>& limits,
            const Field& edge_length,
            const RemeshParams& params) {
    assert(patch.curves.size() == patch.vertices.size());
    assert(patch.panels.size() == patch.triangles.size());
    Remesher(patch, surface, limits, edge_length).run(params);
}

} // namespace weft
