#include "adapt/rest_split.h"

#include "adapt/sqrt3_mesh.h"

#include <algorithm>
#include <cassert>
#include <numbers>

namespace weft {

namespace {

/// Frames nearer to each other, rad, are one: what is left is rounding.
constexpr double k_same_frame = 1e-12;

/// Scales nearer to 1 are rounding: applying them would only add more.
constexpr double k_same_area = 1e-14;

Mat2 matrix(double a, double b, double c, double d) {
    Mat2 m;
    m << a, b, c, d;
    return m;
}

/// The part of a third of the area whose edges are Dm B, from B^-1.
RestTriangle third(const RestTriangle& parent, const Mat2& inverse_B) {
    return {inverse_B * parent.inverse_edges, parent.area / 3.0};
}

double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

double angle_between(const Vec2& from, const Vec2& to) {
    return std::atan2(cross(from, to), from.dot(to));
}

RestTriangle from_edges(const Vec2& e1, const Vec2& e2) {
    const double det = cross(e1, e2);
    return {matrix(e2.y(), -e2.x(), -e1.y(), e1.x()) / det, 0.5 * det};
}

Vec2 turned(const Vec2& v, double angle) {
    return Eigen::Rotation2Dd(angle) * v;
}

} // namespace

RestTriangle parent_rest(const InsertedVertex& record) {
    const auto& r = record.parent_rest;
    return {matrix(r[0], r[2], r[1], r[3]), r[4]};
}

void set_parent_rest(InsertedVertex& record, const RestTriangle& rest) {
    const Mat2& m = rest.inverse_edges;
    record.parent_rest = {m(0, 0), m(1, 0), m(0, 1), m(1, 1), rest.area};
}

// Inverses of the edges in the parent's barycentric terms, Dm' = Dm B. With m0 = (0, 0),
// m1 = (1, 0), m2 = (0, 1) and c = (1/3, 1/3) all of them are integers.

RestTriangle split_rest(const RestTriangle& parent, std::uint32_t k) {
    switch (k) {
    case 0:
        return third(parent, matrix(-1, -2, 1, -1));
    case 1:
        return third(parent, matrix(2, 1, 1, 2));
    default:
        assert(k == 2);
        return third(parent, matrix(-1, 1, -2, -1));
    }
}

RestTriangle trisect_rest(const RestTriangle& parent, std::uint32_t k) {
    switch (k) {
    case 0:
        return third(parent, matrix(2, -1, -1, 2));
    case 1:
        return third(parent, matrix(-1, -1, 1, -2));
    default:
        assert(k == 2);
        return third(parent, matrix(-2, 1, -1, -1));
    }
}

double frame_turn(const RestTriangle& first,
                  std::size_t first_corner,
                  const RestTriangle& second,
                  std::size_t second_corner) {
    const auto m = rest_corners(first);
    const auto n = rest_corners(second);
    const Vec2 a_b = m[(first_corner + 2) % 3] - m[(first_corner + 1) % 3];
    const Vec2 b_a = n[(second_corner + 2) % 3] - n[(second_corner + 1) % 3];
    return angle_between(-b_a, a_b);
}

RestFlip flip_rest(const RestTriangle& first, const RestTriangle& second) {
    const double turn = frame_turn(first, 0, second, 0);
    const double half = std::abs(turn) < k_same_frame ? 0.0 : 0.5 * turn;
    auto m = rest_corners(first);  // P, a, b
    auto n = rest_corners(second); // Q, b, a
    if (half != 0.0) {
        for (std::size_t k = 1; k < 3; ++k) {
            m[k] = turned(m[k], -half);
            n[k] = turned(n[k], half);
        }
    }
    const Vec2 P_Q_by_a = m[1] - n[2]; // the same where the edge has one length
    const Vec2 Q_P_by_b = n[1] - m[2];
    RestFlip flip{{from_edges(m[1], P_Q_by_a), from_edges(n[1], Q_P_by_b)}, 0.0};

    const double area = first.area + second.area;
    flip.least_fraction = std::min(flip.rest[0].area, flip.rest[1].area) / area;
    const double scale = area / (flip.rest[0].area + flip.rest[1].area);
    if (std::abs(scale - 1.0) > k_same_area) {
        for (RestTriangle& rest : flip.rest) {
            rest.inverse_edges /= std::sqrt(scale);
            rest.area *= scale;
        }
    }
    return flip;
}

namespace {

/// Refines every triangle as far as that level allows.
void refine_whole(Cloth& cloth, Index levels) {
    Sqrt3Mesh mesh(cloth);
    for (std::size_t before = 0; before != cloth.triangles.size();) {
        before = cloth.triangles.size();
        mesh.begin(cloth, {}, {.max_level = levels});
        mesh.retry_flips();
        for (std::size_t t = 0; t < before; ++t) {
            while (mesh.can_refine(static_cast<Index>(t)) && mesh.refine(static_cast<Index>(t))) {
            }
        }
        mesh.finish();
    }
}

/// Least angle of what was cut for an inserted vertex and of all parts that it was cut into. Of a
/// pair on an edge each has one side's triangle.
double least_angle_of_cut(const InsertedVertex& record) {
    const RestTriangle parent = parent_rest(record);
    if (parent.area == 0.0) { // beyond a boundary
        return std::numbers::pi / 3.0;
    }
    double least = least_angle(parent);
    for (std::uint32_t k = 0; k < 3; ++k) {
        const bool is_centre = record.insertion == Insertion::Centre;
        const RestTriangle part = is_centre ? split_rest(parent, k) : trisect_rest(parent, k);
        least = std::min(least, least_angle(part));
    }
    return least;
}

} // namespace

double least_rest_angle(const Cloth& cloth) {
    double least = std::numbers::pi / 3.0;
    for (const RestTriangle& rest : cloth.rest) {
        least = std::min(least, least_angle(rest));
    }
    return least;
}

double least_refined_angle(const Cloth& cloth, Index levels) {
    assert(!cloth.refinement.empty());
    Cloth refined = cloth;
    refine_whole(refined, levels);
    // A triangle that is there no more was cut, and the vertex put in remembers it; or it was a
    // part of such a cut and flipped.
    double least = least_rest_angle(refined);
    for (const InsertedVertex& record : refined.refinement.vertices) {
        least = std::min(least, least_angle_of_cut(record));
    }
    return least;
}

} // namespace weft
