#include "scene/law_shape.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace weft {
namespace {

void add_between(std::vector<Softening>& intervals, double from, double to) {
    from = std::max(from, 0.0); // an edge cannot be shorter than nothing
    if (from < to) {
        intervals.push_back({from, to});
    }
}

} // namespace

const char* model_name(Model model) {
    const char* const names[] = {"corotational", "cubic", "linear", "stvk_edge", "stvk_triangle"};
    return names[static_cast<int>(model)];
}

LawShape law_shape(Model model, const SpringParams& params) {
    assert(model != Model::Corotational);
    if (model == Model::StvkEdge) {
        return {3.0, 1.5};
    }
    if (model != Model::Cubic) {
        return {};
    }
    const double d1 = params.a1 - 1.0;
    const double d2 = params.a2 - 1.0;
    const double slope1 = (params.K1 / params.K - 1.0) / d1;
    const double slope2 = (params.K2 / params.K - 1.0) / d2;
    const double q = (slope1 - slope2) / (d1 - d2);
    return {slope1 - q * d1, q};
}

std::vector<Softening> softening(const LawShape& shape) {
    const auto [p, q] = shape;
    const double discriminant = p * p - 4.0 * q;
    std::vector<Softening> intervals;
    if (q == 0.0) {
        if (p > 0.0) {
            add_between(intervals, 0.0, 1.0 - 1.0 / p);
        } else if (p < 0.0) {
            add_between(intervals, 1.0 - 1.0 / p, k_forever);
        }
        return intervals;
    }
    if (discriminant <= 0.0) {
        return intervals;
    }
    // roots of 1 + p e + q e^2 without cancellation
    const double sum = -0.5 * (p + std::copysign(std::sqrt(discriminant), p));
    const auto [low, high] = std::minmax({1.0 + 1.0 / sum, 1.0 + sum / q});
    if (q > 0.0) {
        add_between(intervals, low, high);
    } else {
        add_between(intervals, 0.0, low);
        add_between(intervals, high, k_forever);
    }
    return intervals;
}

std::vector<Softening> softening(Model model, const SpringParams& params) {
    if (model == Model::Corotational || model == Model::StvkTriangle) {
        return {};
    }
    std::vector<Softening> intervals = softening(law_shape(model, params));
    if (params.limit != Vec2(0.0, 0.0)) {
        std::vector<Softening> reached;
        for (const Softening& s : intervals) {
            add_between(reached, std::max(s.from, params.limit[0]),
                        std::min(s.to, params.limit[1]));
        }
        return reached;
    }
    return intervals;
}

std::string softening_text(Model model, const SpringParams& params) {
    std::string text;
    for (const Softening& s : softening(model, params)) {
        text += text.empty() ? "stiffness is negative " : " and ";
        text += s.from == 0.0 ? fmt::format("below the stretch {:.4g}", s.to)
                : s.to == k_forever
                    ? fmt::format("beyond the stretch {:.4g}", s.from)
                    : fmt::format("between the stretches {:.4g} and {:.4g}", s.from, s.to);
    }
    return text;
}

} // namespace weft
