#include "skirt_shape.h"

#include <algorithm>
#include <cmath>

#include "body_field.h"

namespace weft {
namespace {

constexpr int k_rows = 114;             // 5 mm apart
constexpr int k_columns = 97;           // half of the way round; the other half is its mirror image
constexpr double k_axis_z = -0.004;     // m, middle of the waist
constexpr double k_band_margin = 0.007; // m off the body at the waist; less would touch it
constexpr double k_margin = 0.009;      // m off the body below the waist
constexpr double k_flare = 0.24;        // radius gained per height lost below the hips

double row_height(int row) {
    return k_skirt_hem + (k_skirt_waist - k_skirt_hem) * row / (k_rows - 1);
}

/// The outermost place on a horizontal ray from the axis that is `margin` off the body, m; 0 where
/// the ray passes between the legs.
double body_radius(double angle, double height, double margin) {
    const auto excess = [&](double r) {
        return body_distance({r * std::sin(angle), height, k_axis_z + r * std::cos(angle)}) -
               margin;
    };
    // Starts between the trunk and the hands.
    double outer = 0.30;
    double inner = outer;
    while (inner > 0.0 && excess(inner) > 0.0) {
        outer = inner;
        inner -= 0.005;
    }
    if (inner <= 0.0)
        return 0.0;
    for (int step = 0; step < 20; ++step) {
        const double middle = 0.5 * (inner + outer);
        (excess(middle) > 0.0 ? outer : inner) = middle;
    }
    return outer;
}

double smooth_step(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

} // namespace

SkirtShape::SkirtShape() : radii_(static_cast<size_t>(k_rows * k_columns)) {
    wrap_body();
    hang_from_hips();
    smooth();
}

double& SkirtShape::radius(int row, int column) {
    return radii_[static_cast<size_t>(row * k_columns + column)];
}

void SkirtShape::wrap_body() {
    const double pi = std::acos(-1.0);
    for (int row = 0; row < k_rows; ++row)
        for (int column = 0; column < k_columns; ++column) {
            const double height = row_height(row);
            const double margin = k_band_margin + (k_margin - k_band_margin) *
                                                      smooth_step((k_skirt_waist - height) / 0.04);
            radius(row, column) = body_radius(pi * column / (k_columns - 1), height, margin);
        }
    allowed_ = radii_;
}

void SkirtShape::hang_from_hips() {
    const double dy = row_height(1) - row_height(0);
    for (int row = k_rows - 2; row >= 0; --row)
        for (int column = 0; column < k_columns; ++column) {
            const double flare = k_flare * smooth_step((k_skirt_waist - row_height(row)) / 0.20);
            radius(row, column) =
                std::max(radius(row, column), radius(row + 1, column) + flare * dy);
        }
}

void SkirtShape::smooth() {
    for (int pass = 0; pass < 80; ++pass) {
        const std::vector<double> before = radii_;
        const auto at = [&](int row, int column) {
            column = std::abs(column);
            column = column < k_columns ? column : 2 * (k_columns - 1) - column;
            return before[static_cast<size_t>(row * k_columns + column)];
        };
        // The waistband keeps its distance; the hem goes on in a straight line.
        for (int row = 1; row + 1 < k_rows; ++row)
            for (int column = 0; column < k_columns; ++column) {
                // Mostly along the height: around it, it would make the oval waist round.
                const double mean = 0.45 * (at(row - 1, column) + at(row + 1, column)) +
                                    0.05 * (at(row, column - 1) + at(row, column + 1));
                radius(row, column) =
                    std::max(mean, allowed_[static_cast<size_t>(row * k_columns + column)]);
            }
        for (int column = 0; column < k_columns; ++column)
            radius(0, column) = 2.0 * radius(1, column) - radius(2, column);
    }
}

double SkirtShape::operator()(const Vec3& position) const {
    const double pi = std::acos(-1.0);
    const double z = position.z() - k_axis_z;
    const double angle = std::atan2(std::abs(position.x()), z);
    const double column = std::clamp(angle / pi, 0.0, 1.0) * (k_columns - 1);
    const double row =
        std::clamp((position.y() - k_skirt_hem) / (k_skirt_waist - k_skirt_hem), 0.0, 1.0) *
        (k_rows - 1);
    const int i = std::min(static_cast<int>(row), k_rows - 2);
    const int j = std::min(static_cast<int>(column), k_columns - 2);
    const auto at = [this](int r, int c) { return radii_[static_cast<size_t>(r * k_columns + c)]; };
    const double s = row - i;
    const double t = column - j;
    const double wanted = (1.0 - s) * ((1.0 - t) * at(i, j) + t * at(i, j + 1)) +
                          s * ((1.0 - t) * at(i + 1, j) + t * at(i + 1, j + 1));
    return std::hypot(position.x(), z) - wanted;
}

} // namespace weft
