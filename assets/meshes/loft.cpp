#include "loft.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace weft {
namespace {

using Section = Eigen::Matrix<double, 5, 1>; ///< centre, half_width, half_depth

Section to_section(const Station& station) {
    Section section;
    section << station.centre, station.half_width, station.half_depth;
    return section;
}

/// Slope at station i of the parabola through it and its neighbours; one-sided at the ends.
Section slope_at(const std::vector<Section>& values, const std::vector<double>& knots, size_t i) {
    const auto difference = [&](size_t j) -> Section {
        return (values[j + 1] - values[j]) / (knots[j + 1] - knots[j]);
    };
    if (i == 0)
        return difference(0);
    if (i + 1 == values.size())
        return difference(i - 1);
    const double before = knots[i] - knots[i - 1];
    const double after = knots[i + 1] - knots[i];
    return (difference(i - 1) * after + difference(i) * before) / (before + after);
}

/// Cubic Hermite interpolation, `per_span` sections for each pair of stations.
std::vector<Station> interpolate(const std::vector<Station>& stations, int per_span) {
    std::vector<Section> values;
    std::vector<double> knots;
    for (const Station& station : stations) {
        knots.push_back(values.empty()
                            ? 0.0
                            : knots.back() + (station.centre - values.back().head<3>()).norm());
        values.push_back(to_section(station));
    }
    std::vector<Station> result{stations.front()};
    for (size_t i = 0; i + 1 < values.size(); ++i) {
        const double span = knots[i + 1] - knots[i];
        for (int k = 1; k <= per_span; ++k) {
            const double t = static_cast<double>(k) / per_span;
            const Section section = (1 + 2 * t) * (1 - t) * (1 - t) * values[i] +
                                    t * t * (3 - 2 * t) * values[i + 1] +
                                    span * t * (1 - t) * (1 - t) * slope_at(values, knots, i) -
                                    span * t * t * (1 - t) * slope_at(values, knots, i + 1);
            result.push_back({section.head<3>(), section[3], section[4]});
        }
    }
    return result;
}

} // namespace

Loft::Loft(const std::vector<Station>& stations, const LoftParams& params)
    : sections_(interpolate(stations, 5)), params_(params) {
    assert(stations.size() >= 2);
    for (size_t i = 0; i < sections_.size(); ++i) {
        const size_t before = i == 0 ? 0 : i - 1;
        const size_t after = std::min(i + 1, sections_.size() - 1);
        tangents_.push_back((sections_[after].centre - sections_[before].centre).normalized());
    }
}

double Loft::distance(const Vec3& position) const {
    size_t nearest = 0;
    double along = 0.0;
    double least = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i + 1 < sections_.size(); ++i) {
        const Vec3 axis = sections_[i + 1].centre - sections_[i].centre;
        const Vec3 offset = position - sections_[i].centre;
        const double t = std::clamp(offset.dot(axis) / axis.squaredNorm(), 0.0, 1.0);
        const double distance_squared = (offset - t * axis).squaredNorm();
        if (distance_squared < least) {
            least = distance_squared;
            nearest = i;
            along = t;
        }
    }

    const Station& a = sections_[nearest];
    const Station& b = sections_[nearest + 1];
    const auto mix = [along](const auto& p, const auto& q) { return p + along * (q - p); };
    const Vec3 tangent =
        Vec3((1.0 - along) * tangents_[nearest] + along * tangents_[nearest + 1]).normalized();
    const Vec3 side = (params_.side_axis - params_.side_axis.dot(tangent) * tangent).normalized();
    const Vec3 offset = position - Vec3((1.0 - along) * a.centre + along * b.centre);

    // Beyond an end the section becomes half an ellipsoid; between the ends nothing is axial.
    double axial = 0.0;
    double cap = 1.0;
    if (nearest == 0 && along == 0.0) {
        axial = offset.dot(tangent);
        cap = params_.start_cap;
    } else if (nearest + 2 == sections_.size() && along == 1.0) {
        axial = offset.dot(tangent);
        cap = params_.end_cap;
    }

    // k0 = ‖q/r‖ is 1 on the surface; (k0 − 1)/|∇k0| is the distance to first order.
    const Vec3 radii(mix(a.half_width, b.half_width), mix(a.half_depth, b.half_depth), cap);
    const Vec3 q(offset.dot(side), offset.dot(tangent.cross(side)), axial);
    const Vec3 scaled = q.cwiseAbs().cwiseQuotient(radii).cwiseMax(1e-9);
    const double n = params_.exponent;
    const double flat = std::pow(std::pow(scaled[0], n) + std::pow(scaled[1], n), 1.0 / n);
    const double k0 = std::hypot(flat, scaled[2]);
    const Vec3 slope(flat / k0 * std::pow(scaled[0] / flat, n - 1.0) / radii[0],
                     flat / k0 * std::pow(scaled[1] / flat, n - 1.0) / radii[1],
                     scaled[2] / k0 / radii[2]);
    return (k0 - 1.0) / slope.norm();
}

double ellipsoid_distance(const Vec3& position, const Vec3& centre, const Vec3& radii) {
    const Vec3 q = (position - centre).cwiseQuotient(radii);
    const double k0 = q.norm();
    const double k1 = q.cwiseQuotient(radii).norm();
    return k1 > 0.0 ? k0 * (k0 - 1.0) / k1 : -radii.minCoeff();
}

double smooth_union(double a, double b, double width) {
    const double h = std::max(width - std::abs(a - b), 0.0) / width;
    return std::min(a, b) - h * h * h * width / 6.0;
}

} // namespace weft
