#include "geometry/nearest_surface.h"

#include "geometry/distance.h"

namespace weft {

namespace {

Vec3 unit(const Vec3& v) {
    const double length = v.norm();
    return length > 0.0 ? Vec3(v / length) : Vec3::Zero();
}

/// A nearest point this close to the surface (m) has no direction of its own from there.
constexpr double k_on_surface = 1e-12;

} // namespace

NearestSurface::NearestSurface(std::vector<Vec3> positions, std::span<const Triangle> triangles)
    : positions_(std::move(positions)), triangles_(triangles.begin(), triangles.end()) {
    std::erase_if(triangles_, [&](const Triangle& t) {
        return triangle_area(positions_[at(t[0])], positions_[at(t[1])], positions_[at(t[2])]) <=
               0.0;
    });
    topology_ = build_edges(triangles_);
    vertex_normals_.assign(positions_.size(), Vec3::Zero());
    std::vector<Box> boxes;
    for (const Triangle& t : triangles_) {
        const std::array<Vec3, 3> x{positions_[at(t[0])], positions_[at(t[1])],
                                    positions_[at(t[2])]};
        face_normals_.push_back(triangle_normal(x[0], x[1], x[2]));
        boxes.push_back(unite(segment_box(x[0], x[1], 0.0), segment_box(x[2], x[2], 0.0)));
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 a = x[(k + 1) % 3] - x[k];
            const Vec3 b = x[(k + 2) % 3] - x[k];
            const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
            vertex_normals_[at(t[k])] += angle * face_normals_.back();
        }
    }
    for (Vec3& n : vertex_normals_) {
        n = unit(n);
    }
    on_boundary_.assign(positions_.size(), 0);
    for (const MeshEdge& edge : topology_.edges) {
        if (edge.is_boundary()) {
            on_boundary_[at(edge.v[0])] = 1;
            on_boundary_[at(edge.v[1])] = 1;
        }
    }
    tree_ = BoxTree(std::span<const Box>(boxes));
}

/// Normal of the face, edge or vertex that a nearest point lies on.
Vec3 NearestSurface::normal_at(Index triangle, const Vec3& weights, bool& is_on_boundary) const {
    const Triangle& t = triangles_[at(triangle)];
    std::size_t zeros = 0;
    std::size_t zero = 0;
    std::size_t one = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const bool is_zero = weights[static_cast<Eigen::Index>(k)] <= 0.0;
        zeros += is_zero;
        (is_zero ? zero : one) = k;
    }
    if (zeros == 0) {
        is_on_boundary = false;
        return face_normals_[at(triangle)];
    }
    if (zeros == 1) {
        const MeshEdge& edge = topology_.edges[at(topology_.triangle_edges[at(triangle)][zero])];
        is_on_boundary = edge.is_boundary();
        const Vec3& first = face_normals_[at(edge.triangle[0])];
        return is_on_boundary ? first : unit(first + face_normals_[at(edge.triangle[1])]);
    }
    is_on_boundary = on_boundary_[at(t[one])] != 0;
    return vertex_normals_[at(t[one])];
}

std::optional<SurfacePoint> NearestSurface::find(const Vec3& p, double reach) const {
    double limit = reach * reach;
    Index nearest = k_no_index;
    Vec3 weights = Vec3::Zero();
    const auto place = [&](Index t, const Vec3& w) -> Vec3 {
        const Triangle& v = triangles_[at(t)];
        return w[0] * positions_[at(v[0])] + w[1] * positions_[at(v[1])] +
               w[2] * positions_[at(v[2])];
    };
    tree_.near(p, limit, [&](Index t) {
        const Triangle& v = triangles_[at(t)];
        const Vec3 w = closest_weights_on_triangle(p, positions_[at(v[0])], positions_[at(v[1])],
                                                   positions_[at(v[2])]);
        const double distance_squared = (p - place(t, w)).squaredNorm();
        if (distance_squared < limit) {
            limit = distance_squared;
            nearest = t;
            weights = w;
        }
    });
    if (nearest == k_no_index) {
        return std::nullopt;
    }
    SurfacePoint found{place(nearest, weights), Vec3::Zero(), 0.0, false};
    const Vec3 mean_normal = normal_at(nearest, weights, found.is_on_boundary);
    const Vec3 away = p - found.place;
    const double distance = away.norm();
    const double side = away.dot(mean_normal) < 0.0 ? -1.0 : 1.0;
    found.height = side * distance;
    found.normal = distance > k_on_surface ? Vec3(side / distance * away) : mean_normal;
    return found;
}

std::optional<double>
NearestSurface::first_hit(const Vec3& p, const Vec3& direction, double reach) const {
    double nearest = reach;
    tree_.query(segment_box(p, p + reach * direction, 0.0), [&](Index t) {
        const Triangle& v = triangles_[at(t)];
        const Vec3& a = positions_[at(v[0])];
        const Vec3 ab = positions_[at(v[1])] - a;
        const Vec3 ac = positions_[at(v[2])] - a;
        const double volume = direction.dot(ab.cross(ac));
        if (volume <= 0.0) {
            return; // comes in, or passes along
        }
        // Moeller and Trumbore 1997
        const Vec3 from_a = p - a;
        const double u = direction.dot(from_a.cross(ac)) / volume;
        const double w = -direction.dot(from_a.cross(ab)) / volume;
        const double way = -from_a.dot(ab.cross(ac)) / volume;
        if (u >= 0.0 && w >= 0.0 && u + w <= 1.0 && way > 0.0 && way < nearest) {
            nearest = way;
        }
    });
    return nearest < reach ? std::optional<double>(nearest) : std::nullopt;
}

} // namespace weft
