#include "validation/uniaxial.h"

#include <fmt/core.h>

#include <cmath>

#include "validation/experiments.h"
#include "validation/sheet_world.h"
#include "validation/statics.h"

namespace weft {

namespace {

/// Mean of a component of u over vertices.
double mean(const Eigen::VectorXd& u, std::span<const Index> vertices, int component) {
    double sum = 0.0;
    for (const Index v : vertices) {
        sum += u[3 * v + component];
    }
    return sum / static_cast<double>(vertices.size());
}

} // namespace

Elasticity tensile_test(const Sheet& sheet, const Eigen::SparseMatrix<double>& stiffness) {
    const auto side = [&](int axis, double at) {
        return vertices_where(sheet, [=](const Vec2& p) { return std::abs(p[axis] - at) < 1e-9; });
    };
    const std::vector<Index> left = side(0, 0.0);
    const std::vector<Index> right = side(0, 1.0);
    StaticLoad load(sheet.points.size());
    load.hold_all(2);
    for (const Index v : left) {
        load.hold(v, 0);
    }
    for (const Index v : right) {
        load.hold(v, 0, 1.0);
    }
    load.hold(left.front(), 1);
    const Eigen::VectorXd u = linear_response(stiffness, load);
    const Eigen::VectorXd force = stiffness * u;
    return {mean(force, right, 0) * static_cast<double>(right.size()),
            mean(u, side(1, 0.0), 1) - mean(u, side(1, 1.0), 1)};
}

ValidationRows validate_uniaxial() {
    constexpr double k_modulus = 1000.0;
    constexpr double k_poisson = 0.3;
    ClothParams cloth;
    cloth.fabric = isotropic_fabric(k_modulus, k_poisson);
    ValidationRows rows;
    for (const Pattern pattern : k_patterns) {
        const Sheet sheet = make_sheet(pattern, 8, 8, 1.0, 1.0);
        const char* name = name_of(pattern);
        const World world = sheet_world(sheet, cloth);
        const Elasticity found = tensile_test(sheet, stiffness_matrix(world, empty_space()));
        rows.push_back({.what = fmt::format("Young's modulus: {}", name),
                        .unit = "N/m",
                        .theory = k_modulus,
                        .measured = found.modulus,
                        .tolerance = 1e-12,
                        .note = "8 x 8 cells"});
        rows.push_back({.what = fmt::format("Poisson ratio: {}", name),
                        .theory = k_poisson,
                        .measured = found.poisson,
                        .tolerance = 1e-12,
                        .note = "8 x 8 cells"});
    }
    return rows;
}

} // namespace weft
