#pragma once

#include "forces/edge_law.h"

#include <algorithm>
#include <cmath>

namespace weft {

/// One edge at work, inlined into the loops over many: see edge_terms.
class EdgeKernel {
public:
    /// @param difference  x0 - x1, m
    EdgeKernel(const EdgeLaw& law, double stiffness, double rest_length, const Vec3& difference)
        : difference_(difference), length_(difference.norm()) {
        const double inverse = 1.0 / rest_length;
        const double e = (length_ - rest_length) * inverse;
        stretch_ = length_ * inverse;
        tension_ =
            stiffness * rest_length * e * (1.0 + e * (0.5 * law.shape.p + e * (law.shape.q / 3.0)));
        along_ = stiffness * (1.0 + e * (law.shape.p + e * law.shape.q));
        if (stretch_ > law.limit.greatest || stretch_ < law.limit.least) {
            limit_ = limit_response(law.limit, rest_length, stretch_);
        }
        shortest_ = k_shortest * rest_length;
    }

    double energy(const EdgeLaw& law, double stiffness, double rest_length) const {
        return edge_response(law.shape, stiffness, rest_length, stretch_).energy + limit_.energy;
    }

    /// On end 0. @param rate  v0 - v1, m/s
    Vec3 force(const EdgeLaw& law, const Vec3& rate) const {
        const double inverse = 1.0 / std::max(length_, shortest_);
        Vec3 force = (-(tension_ + limit_.tension) * inverse) * difference_ - law.damping * rate;
        if (limit_.stiffness > 0.0) {
            const double approach = difference_.dot(rate) * inverse * inverse;
            force -= (k_limit_damping_time * limit_.stiffness * approach) * difference_;
        }
        return force;
    }

    /// Block (0, 0) of the system; (0, 1) is its negative.
    Mat3
    block(const EdgeLaw& law, double stiffness, double rest_length, SystemScales scales) const {
        const double r = std::max(length_, shortest_);
        const double inverse = 1.0 / r;
        double along = along_;
        double across = (tension_ + limit_.tension) * inverse;
        if (law.jacobian_damping != 1.0) {
            const CubicCoefficients k = cubic_coefficients(law.shape, stiffness, rest_length);
            const double change = law.jacobian_damping - 1.0;
            along += change * 2.0 * k.b * r;
            across += change * (k.b * r + k.d * inverse);
        }
        across = scales.stiffness * std::max(across, 0.0) + scales.damping * law.damping;
        along =
            scales.stiffness * (std::max(along, k_least_stiffness * stiffness) + limit_.stiffness) +
            scales.damping * (law.damping + k_limit_damping_time * limit_.stiffness);
        const Vec3 n = inverse * difference_;
        const Vec3 weighted = (along - across) * n;
        Mat3 block = weighted * n.transpose();
        block.diagonal().array() += across;
        return block;
    }

private:
    /// Share of the rest length below which the direction of an edge fades out.
    static constexpr double k_shortest = 1e-6;

    Vec3 difference_;
    double length_, stretch_, tension_, along_, shortest_;
    EdgeResponse limit_;
};

} // namespace weft
