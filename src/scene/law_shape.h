#pragma once

#include "scene/params.h"

#include <vector>

namespace weft {

/// As in the scene file.
const char* model_name(Model model);

/// The form that the three laws of edges have in common. At stretch s = r / L, with e = s - 1, an
/// edge of stiffness K at rest has
///
///     stiffness  g' = K [1 + p e + q e^2]                        N/m
///     tension    g  = K L [e + p/2 e^2 + q/3 e^3]                N, pulls where positive
///     energy     E  = K L^2 [e^2/2 + p/6 e^3 + q/12 e^4]         J
///
/// linear: p = q = 0; stvk_edge, g = K L (s^3 - s) / 2: p = 3, q = 3/2; cubic: see below.
struct LawShape {
    double p = 0.0, q = 0.0;
    bool operator==(const LawShape&) const = default;
};

/// The shape of an edge model. Cubic: g' is K1 at stretch a1 and K2 at a2,
///
///     q = [(K1/K - 1)/d1 - (K2/K - 1)/d2] / (d1 - d2),  p = (K1/K - 1)/d1 - q d1
///
/// with d1 = a1 - 1, d2 = a2 - 1: the solution of the four conditions of Vogiannou et al. 2010
/// (4)-(8), which lose up to nine digits when solved as a 4x4 system for small edges.
LawShape law_shape(Model model, const SpringParams& params);

/// Stretches between which the stiffness of a law is negative; `to` may be infinite.
struct Softening {
    double from, to;
};

/// Where the stiffness of a law is negative: there it holds less the more it is strained, so it
/// snaps through. At most two intervals, ascending; for a monotone law (p^2 <= 4 q) none.
std::vector<Softening> softening(const LawShape& shape);

/// The same for an object: only of stretches within its limit. None for models without edges.
std::vector<Softening> softening(Model model, const SpringParams& params);

/// Says it in words, `stiffness is negative between the stretches 0.8 and 0.9`, or "".
std::string softening_text(Model model, const SpringParams& params);

} // namespace weft
