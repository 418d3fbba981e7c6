#include "flatten.h"

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

namespace weft {
namespace {

using Mat2 = Eigen::Matrix2d;

/// The triangles of one panel with their own vertex numbers.
struct Panel {
    std::vector<VertexIndex> vertices; ///< indices into the patch
    std::vector<Triangle> triangles;   ///< indices into `vertices`
};

/// Numbers the connected pieces of the panels from 0: the two sleeves are one panel but two pieces.
std::vector<int> number_pieces(const Patch& patch) {
    std::map<std::pair<VertexIndex, VertexIndex>, size_t> left; // triangle beside a directed edge
    for (size_t t = 0; t < patch.triangles.size(); ++t)
        for (size_t k = 0; k < 3; ++k)
            left[{patch.triangles[t][k], patch.triangles[t][(k + 1) % 3]}] = t;
    std::vector<int> piece(patch.triangles.size(), -1);
    int count = 0;
    for (size_t start = 0; start < piece.size(); ++start) {
        if (piece[start] >= 0)
            continue;
        std::vector<size_t> open{start};
        piece[start] = count;
        while (!open.empty()) {
            const size_t t = open.back();
            open.pop_back();
            for (size_t k = 0; k < 3; ++k) {
                const auto beside =
                    left.find({patch.triangles[t][(k + 1) % 3], patch.triangles[t][k]});
                if (beside == left.end() || piece[beside->second] >= 0 ||
                    patch.panels[beside->second] != patch.panels[t])
                    continue;
                piece[beside->second] = count;
                open.push_back(beside->second);
            }
        }
        ++count;
    }
    return piece;
}

Panel take_panel(const Patch& patch, const std::vector<int>& piece, int number) {
    Panel panel;
    std::map<VertexIndex, VertexIndex> local;
    for (size_t t = 0; t < patch.triangles.size(); ++t) {
        if (piece[t] != number)
            continue;
        Triangle triangle = patch.triangles[t];
        for (VertexIndex& v : triangle) {
            const auto [place, is_new] =
                local.try_emplace(v, static_cast<VertexIndex>(panel.vertices.size()));
            if (is_new)
                panel.vertices.push_back(v);
            v = place->second;
        }
        panel.triangles.push_back(triangle);
    }
    return panel;
}

/// A triangle laid in the plane: its edges from corner 0, as columns.
Mat2 lay_flat(const Vec3& x0, const Vec3& x1, const Vec3& x2) {
    const Vec3 e = x1 - x0;
    const Vec3 f = x2 - x0;
    Mat2 result;
    result << e.norm(), f.dot(e.normalized()), 0.0, e.cross(f).norm() / e.norm();
    return result;
}

class Flattener {
public:
    Flattener(const Patch& patch, const Panel& panel)
        : patch_(patch), panel_(panel),
          is_one_panel_(panel.triangles.size() == patch.triangles.size()) {
        for (const auto& [a, b, c] : panel.triangles)
            rest_.push_back(lay_flat(x(a), x(b), x(c)));
        for (const Triangle& tri : panel.triangles)
            for (size_t k = 0; k < 3; ++k)
                next_[{tri[k], tri[(k + 1) % 3]}] = tri[(k + 2) % 3];
    }

    std::vector<Vec2> run() {
        start_on_circle();
        const Eigen::SparseMatrix<double> laplacian = cotangent_laplacian();
        Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(laplacian);
        for (int iteration = 0; iteration < 300; ++iteration)
            u_ = solver.solve(rotated_edges());
        upright();
        std::vector<Vec2> result;
        for (Eigen::Index i = 0; i < u_.rows(); ++i)
            result.emplace_back(u_.row(i).transpose());
        return result;
    }

private:
    const Vec3& x(VertexIndex v) const {
        return patch_.vertices[static_cast<size_t>(panel_.vertices[static_cast<size_t>(v)])];
    }

    Vec2 u(VertexIndex v) const { return u_.row(v).transpose(); }

    Eigen::Index size() const { return static_cast<Eigen::Index>(panel_.vertices.size()); }

    std::vector<VertexIndex> border() const {
        std::map<VertexIndex, VertexIndex> after;
        for (const auto& [edge, opposite] : next_)
            if (!next_.contains({edge.second, edge.first}))
                after[edge.first] = edge.second;
        std::vector<VertexIndex> loop{after.begin()->first};
        while (after.at(loop.back()) != loop.front())
            loop.push_back(after.at(loop.back()));
        if (loop.size() != after.size())
            throw std::runtime_error("a panel to be flattened is not a disk");
        return loop;
    }

    /// Tutte's embedding: the border on a circle, each inner vertex the mean of its neighbours. It
    /// never folds, so the iterations start from the right side up.
    void start_on_circle() {
        const std::vector<VertexIndex> loop = border();
        double around = 0.0;
        std::vector<double> arc;
        for (size_t i = 0; i < loop.size(); ++i) {
            arc.push_back(around);
            around += (x(loop[(i + 1) % loop.size()]) - x(loop[i])).norm();
        }
        std::vector<bool> is_border(panel_.vertices.size(), false);
        Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(size(), 2);
        const double pi = std::acos(-1.0);
        for (size_t i = 0; i < loop.size(); ++i) {
            const double angle = 2.0 * pi * arc[i] / around;
            is_border[static_cast<size_t>(loop[i])] = true;
            right.row(loop[i]) << around / (2.0 * pi) * std::cos(angle),
                around / (2.0 * pi) * std::sin(angle);
        }
        std::vector<Eigen::Triplet<double>> entries;
        for (VertexIndex v = 0; v < size(); ++v)
            if (is_border[static_cast<size_t>(v)])
                entries.emplace_back(v, v, 1.0);
        for (const auto& [edge, opposite] : next_) {
            if (is_border[static_cast<size_t>(edge.first)])
                continue;
            entries.emplace_back(edge.first, edge.first, 1.0);
            entries.emplace_back(edge.first, edge.second, -1.0);
        }
        Eigen::SparseMatrix<double> matrix(size(), size());
        matrix.setFromTriplets(entries.begin(), entries.end());
        Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(matrix);
        u_ = solver.solve(right);
    }

    /// Cotangent of the angle at corner k of triangle t, at rest.
    double cotangent(size_t t, size_t k) const {
        const Triangle& tri = panel_.triangles[t];
        const Vec3 e = x(tri[(k + 1) % 3]) - x(tri[k]);
        const Vec3 f = x(tri[(k + 2) % 3]) - x(tri[k]);
        return e.dot(f) / e.cross(f).norm();
    }

    Eigen::SparseMatrix<double> cotangent_laplacian() const {
        std::vector<Eigen::Triplet<double>> entries;
        for (size_t t = 0; t < panel_.triangles.size(); ++t)
            for (size_t k = 0; k < 3; ++k) {
                const VertexIndex a = panel_.triangles[t][(k + 1) % 3];
                const VertexIndex b = panel_.triangles[t][(k + 2) % 3];
                const double weight = cotangent(t, k);
                entries.emplace_back(a, a, weight);
                entries.emplace_back(b, b, weight);
                entries.emplace_back(a, b, -weight);
                entries.emplace_back(b, a, -weight);
            }
        entries.emplace_back(0, 0, 1.0); // holds the panel in place
        Eigen::SparseMatrix<double> matrix(size(), size());
        matrix.setFromTriplets(entries.begin(), entries.end());
        return matrix;
    }

    /// The map of triangle t from its rest shape to the pattern.
    Mat2 map_of(size_t t) const {
        const auto& [a, b, c] = panel_.triangles[t];
        Mat2 now;
        now << u(b) - u(a), u(c) - u(a);
        return now * rest_[t].inverse();
    }

    Eigen::MatrixX2d rotated_edges() const {
        Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(size(), 2);
        for (size_t t = 0; t < panel_.triangles.size(); ++t) {
            const Mat2 map = map_of(t);
            const double angle = std::atan2(map(1, 0) - map(0, 1), map(0, 0) + map(1, 1));
            const Mat2 rotation = Eigen::Rotation2Dd(angle).toRotationMatrix();
            const std::array<Vec2, 3> rest{Vec2::Zero(), rest_[t].col(0), rest_[t].col(1)};
            for (size_t k = 0; k < 3; ++k) {
                const size_t i = (k + 1) % 3;
                const size_t j = (k + 2) % 3;
                const Vec2 edge = cotangent(t, k) * (rotation * (rest[i] - rest[j]));
                right.row(panel_.triangles[t][i]) += edge.transpose();
                right.row(panel_.triangles[t][j]) -= edge.transpose();
            }
        }
        return right;
    }

    /// Turns the panel so that the gradient of world y, summed where the panel is upright, is +v.
    void upright() {
        Vec2 sum = Vec2::Zero();
        for (size_t t = 0; t < panel_.triangles.size(); ++t) {
            const auto& [a, b, c] = panel_.triangles[t];
            // A skirt's one panel turns with the body; its front decides.
            if (is_one_panel_ && x(a).z() < 0.8 * std::abs(x(a).x()))
                continue;
            Mat2 edges;
            edges << u(b) - u(a), u(c) - u(a);
            const Vec2 rise(x(b).y() - x(a).y(), x(c).y() - x(a).y());
            sum += rest_[t].determinant() * (edges.transpose().inverse() * rise);
        }
        const Vec2 v = sum.normalized();
        Mat2 turn;
        turn << v.y(), -v.x(), v.x(), v.y();
        u_ = (u_ * turn.transpose()).eval();
    }

    const Patch& patch_;
    const Panel& panel_;
    std::vector<Mat2> rest_;
    std::map<std::pair<VertexIndex, VertexIndex>, VertexIndex> next_; ///< directed edges
    Eigen::MatrixX2d u_;
    bool is_one_panel_;
};

Distortion measure_distortion(const Patch& patch, const FlatPattern& pattern) {
    Distortion result;
    double total_area = 0.0;
    for (size_t t = 0; t < patch.triangles.size(); ++t) {
        const auto x = [&](size_t k) {
            return patch.vertices[static_cast<size_t>(patch.triangles[t][k])];
        };
        const auto u = [&](size_t k) {
            return pattern.positions[static_cast<size_t>(pattern.triangles[t][k])];
        };
        Mat2 flat;
        flat << u(1) - u(0), u(2) - u(0);
        const Mat2 space = lay_flat(x(0), x(1), x(2));
        const Vec2 sigma = (space * flat.inverse()).jacobiSvd().singularValues();
        const double stretch = std::max(sigma[0], 1.0 / sigma[1]) - 1.0;
        const double area = 0.5 * space.determinant();
        result.worst = std::max(result.worst, stretch);
        result.mean += area * stretch;
        total_area += area;
    }
    result.mean /= total_area;
    return result;
}

} // namespace

FlatPattern flatten(const Patch& patch) {
    constexpr double k_gap = 0.05; // m between panels
    FlatPattern pattern;
    pattern.triangles.reserve(patch.triangles.size());
    double right_end = 0.0;
    std::map<int, std::vector<Triangle>> of_piece;
    const std::vector<int> piece = number_pieces(patch);
    for (const int number : std::set<int>(piece.begin(), piece.end())) {
        const Panel panel = take_panel(patch, piece, number);
        const std::vector<Vec2> flat = Flattener(patch, panel).run();
        Vec2 low = flat.front();
        double high = flat.front().x();
        for (const Vec2& position : flat) {
            low = low.cwiseMin(position);
            high = std::max(high, position.x());
        }
        const auto first = static_cast<VertexIndex>(pattern.positions.size());
        for (const Vec2& position : flat)
            pattern.positions.push_back(position - low + Vec2(right_end, 0.0));
        right_end += high - low.x() + k_gap;
        for (const auto& [a, b, c] : panel.triangles)
            of_piece[number].push_back({a + first, b + first, c + first});
    }
    std::map<int, size_t> taken;
    for (const int number : piece)
        pattern.triangles.push_back(of_piece[number][taken[number]++]);
    pattern.distortion = measure_distortion(patch, pattern);
    return pattern;
}

FlatPattern project_flat(const Patch& patch, const Vec3& u_axis, const Vec3& v_axis) {
    FlatPattern pattern;
    for (const Vec3& position : patch.vertices)
        pattern.positions.emplace_back(position.dot(u_axis), position.dot(v_axis));
    pattern.triangles = patch.triangles;
    return pattern;
}

Patch cut_open_behind(const Patch& patch, unsigned curve) {
    Patch result = patch;
    std::map<VertexIndex, VertexIndex> copies;
    for (Triangle& triangle : result.triangles) {
        double x_sum = 0.0;
        for (const VertexIndex v : triangle)
            x_sum += patch.vertices[static_cast<size_t>(v)].x();
        if (x_sum > 0.0)
            continue;
        for (VertexIndex& v : triangle) {
            const auto i = static_cast<size_t>(v);
            if ((patch.curves[i] & curve) == 0 || patch.vertices[i].z() > 0.0)
                continue;
            const auto [place, is_new] =
                copies.try_emplace(v, static_cast<VertexIndex>(result.vertices.size()));
            if (is_new) {
                result.vertices.push_back(patch.vertices[i]);
                result.curves.push_back(patch.curves[i]);
            }
            v = place->second;
        }
    }
    return result;
}

} // namespace weft
