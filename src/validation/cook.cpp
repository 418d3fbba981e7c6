#include "validation/experiment_world.h"
#include "validation/experiments.h"
#include "validation/statics.h"

#include <fmt/core.h>

#include <array>

/// Cook's membrane: a tapered panel (0,0) (48,44) (48,60) (0,44), clamped on the left, a unit shear
/// on the right edge; E = 1, nu = 1/3, linear. Its table checks every entry of the stiffness.
namespace weft {

namespace {

/// Vertical displacement of (48, 52) on n x n linear triangles, n = 2, 4 .. 128; own calculations
/// with a separate program. Extrapolated limit 23.967, literature 23.96.
constexpr std::array k_short_diagonals{11.9928, 18.2837, 22.0224, 23.4120,
                                       23.8155, 23.9241, 23.9547};
constexpr std::array k_long_diagonals{6.7425, 11.2520, 17.3312, 21.5922, 23.2751, 23.7742, 23.9126};

/// The taper of n x n cells. Short: cut from the lower right to the upper left of each.
Sheet panel(int n, bool is_short) {
    Sheet sheet = one_diagonal_sheet(n, n, 1.0, 1.0);
    if (is_short) {
        for (std::size_t t = 0; t < sheet.triangles.size(); t += 2) {
            const Index a = sheet.triangles[t][0]; // the lower left of its cell
            const Index b = a + 1;
            const Index c = a + n + 1;
            sheet.triangles[t] = {a, b, c};
            sheet.triangles[t + 1] = {b, c + 1, c};
        }
    }
    for (Vec2& p : sheet.points) {
        const double below = 44.0 * p.x();
        const double above = 44.0 + 16.0 * p.x();
        p = Vec2(48.0 * p.x(), below + (above - below) * p.y());
    }
    return sheet;
}

double tip_deflection(int n, bool is_short) {
    const Sheet sheet = panel(n, is_short);
    ClothParams cloth;
    cloth.fabric = isotropic_membrane(1.0, 1.0 / 3.0);
    const World world = sheet_world(sheet, cloth);
    StaticLoad load(world.vertex_count());
    load.hold_all(2);
    for (Index j = 0; j <= n; ++j) {
        load.hold(j * (n + 1));
        const double weight = (j == 0 || j == n ? 0.5 : 1.0) / n;
        load.add(j * (n + 1) + n, Vec3(0.0, weight, 0.0));
    }
    const Eigen::VectorXd u = linear_response(stiffness_matrix(world, empty_space()), load);
    return u[3 * ((n / 2) * (n + 1) + n) + 1];
}

} // namespace

ValidationRows validate_cook() {
    ValidationRows rows;
    for (const bool is_short : {true, false}) {
        int n = 2;
        for (const double theory : is_short ? k_short_diagonals : k_long_diagonals) {
            rows.push_back({.what = fmt::format("tip deflection: {} diagonals: n = {}",
                                                is_short ? "short" : "long", n),
                            .unit = "m",
                            .theory = theory,
                            .measured = tip_deflection(n, is_short),
                            .tolerance = 1e-4,
                            .note = "theory: the same linear triangles by a separate program"});
            n *= 2;
        }
    }
    return rows;
}

} // namespace weft
