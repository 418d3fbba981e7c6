#include "forces/edge_law.h"

#include <fmt/core.h>

#include <array>

/// Tension g/(K L) and stiffness g'/K of the laws of edges over stretch, as CSV: of the springs
/// that figures 1 and 2 of Vogiannou et al. 2010 compare.
int main() {
    using namespace weft;
    struct Curve {
        const char* name;
        LawShape shape;
    };
    const auto cubic = [](double K1) {
        return law_shape(Model::Cubic, {.K = 1.0, .K1 = K1, .K2 = 2.0, .a1 = 1.1, .a2 = 0.9});
    };
    const std::array curves{Curve{"linear", law_shape(Model::Linear, {})},
                            Curve{"stvk_edge", law_shape(Model::StvkEdge, {})},
                            Curve{"cubic K1=2K", cubic(2.0)}, Curve{"cubic K1=4K", cubic(4.0)},
                            Curve{"cubic K1=6K", cubic(6.0)}};
    fmt::print("law,stretch,tension,stiffness\n");
    for (const Curve& curve : curves) {
        for (int i = 0; i <= 200; ++i) {
            const double s = 0.01 * i;
            const EdgeResponse r = edge_response(curve.shape, 1.0, 1.0, s);
            fmt::print("{},{:.2f},{:.9g},{:.9g}\n", curve.name, s, r.tension, r.stiffness);
        }
    }
    return 0;
}
