#include "validation/experiment_world.h"
#include "validation/experiments.h"
#include "validation/statics.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

/// Why triangles and not springs: the same tensile test on three patterns of mesh. The triangles
/// return the modulus that they were given; a net of equal springs returns one of its own for each
/// pattern, and refinement does not bring them together.
namespace weft {

namespace {

constexpr int k_coarse = 8;
constexpr int k_fine = 32;

/// K of a net in which every edge is a spring of 1 N/m.
Eigen::SparseMatrix<double> spring_net(const Sheet& sheet) {
    std::vector<Eigen::Triplet<double>> entries;
    for (const MeshEdge& edge : build_edges(sheet.triangles).edges) {
        const auto [a, b] = edge.v;
        const Vec2 along =
            (sheet.points[static_cast<std::size_t>(b)] - sheet.points[static_cast<std::size_t>(a)])
                .normalized();
        for (int i = 0; i < 2; ++i) {
            for (int j = 0; j < 2; ++j) {
                const double k = along[i] * along[j];
                entries.emplace_back(3 * a + i, 3 * a + j, k);
                entries.emplace_back(3 * b + i, 3 * b + j, k);
                entries.emplace_back(3 * a + i, 3 * b + j, -k);
                entries.emplace_back(3 * b + i, 3 * a + j, -k);
            }
        }
    }
    for (int i = 0; i < 3 * static_cast<int>(sheet.points.size()); ++i) {
        entries.emplace_back(i, i, 0.0); // every component has its diagonal
    }
    const auto size = static_cast<Eigen::Index>(3 * sheet.points.size());
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

Eigen::SparseMatrix<double> triangles(const Sheet& sheet) {
    ClothParams cloth;
    cloth.fabric = isotropic_membrane(1.0, 0.3);
    return stiffness_matrix(sheet_world(sheet, cloth), empty_space());
}

/// Drop of the middle of the lower side of the square, held along its upper side, under a weight of
/// 1 N/m^2; small displacements.
double drop(const Sheet& sheet, int n, const Eigen::SparseMatrix<double>& stiffness) {
    StaticLoad load(sheet.points.size());
    load.hold_all(2);
    for (const Index v : vertices_where(sheet, [](const Vec2& p) { return p.y() > 1.0 - 1e-9; })) {
        load.hold(v);
    }
    for (const Triangle& t : sheet.triangles) {
        const auto at = [&](std::size_t k) { return sheet.points[static_cast<std::size_t>(t[k])]; };
        Mat2 edges;
        edges << at(1) - at(0), at(2) - at(0);
        const double third = std::abs(edges(0, 0) * edges(1, 1) - edges(0, 1) * edges(1, 0)) / 6.0;
        for (const Index v : t) {
            load.add(v, Vec3(0.0, -third, 0.0));
        }
    }
    return -linear_response(stiffness, load)[3 * (n / 2) + 1];
}

/// Greatest minus least over the patterns, as a fraction of their mean.
double spread(const std::array<double, k_patterns.size()>& values) {
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    return (*greatest - *least) * static_cast<double>(values.size()) /
           std::accumulate(values.begin(), values.end(), 0.0);
}

/// What both models say of the square on each pattern at one size.
struct Findings {
    std::array<double, k_patterns.size()> spring_modulus, triangle_modulus, spring_drop,
        triangle_drop;
};

Findings find(int n) {
    Findings found{};
    for (std::size_t pattern = 0; pattern < k_patterns.size(); ++pattern) {
        const Sheet sheet = make_sheet(k_patterns[pattern], n, n, 1.0, 1.0);
        const auto springs = spring_net(sheet);
        const auto elements = triangles(sheet);
        found.spring_modulus[pattern] = tensile_test(sheet, springs).modulus;
        found.triangle_modulus[pattern] = tensile_test(sheet, elements).modulus;
        found.spring_drop[pattern] = drop(sheet, n, springs);
        found.triangle_drop[pattern] = drop(sheet, n, elements);
    }
    return found;
}

/// The limit of a value with an error of first order in 1/n.
double limit(double at_coarse, double at_fine) {
    return at_fine + (at_fine - at_coarse) * k_coarse / (k_fine - k_coarse);
}

ValidationRow
modulus_row(const std::string& what, double theory, double measured, double tolerance) {
    return {
        .what = what, .unit = "K", .theory = theory, .measured = measured, .tolerance = tolerance};
}

} // namespace

ValidationRows validate_mesh_independence() {
    const Findings coarse = find(k_coarse);
    const Findings fine = find(k_fine);
    double triangle_error = 0.0;
    for (const Findings& found : {coarse, fine}) {
        for (const double modulus : found.triangle_modulus) {
            triangle_error = std::max(triangle_error, std::abs(modulus - 1.0));
        }
    }
    const auto springs_at_limit = [&](std::size_t pattern) {
        return limit(coarse.spring_modulus[pattern], fine.spring_modulus[pattern]);
    };
    ValidationRows rows{
        {.what = "modulus of triangles: greatest error on 3 patterns of 2 sizes",
         .theory = 0.0,
         .measured = triangle_error,
         .tolerance = 1e-10,
         .relative = false,
         .note = "one diagonal; union jack; irregular; n = 8 and 32"},
        modulus_row("modulus of springs: one diagonal: n = 8", 1.125, coarse.spring_modulus[0],
                    1e-3),
        modulus_row("modulus of springs: union jack: n = 8", 1.448, coarse.spring_modulus[1], 1e-3),
        modulus_row("modulus of springs: one diagonal: limit", 1.0, springs_at_limit(0), 0.01),
        modulus_row("modulus of springs: union jack: limit", 4.0 / 3.0, springs_at_limit(1), 0.01)};
    rows.push_back({.what = "hanging square: spread over 3 patterns: triangles: n = 32",
                    .theory = 0.0,
                    .measured = spread(fine.triangle_drop),
                    .tolerance = 0.005,
                    .relative = false,
                    .note = fmt::format("n = 8: {:.4f}", spread(coarse.triangle_drop))});
    rows.push_back(
        {.what = "hanging square: spread of springs at n = 32 / at n = 8",
         .theory = 1.0,
         .measured = spread(fine.spring_drop) / spread(coarse.spring_drop),
         .tolerance = 0.2,
         .note = fmt::format("does not shrink; n = 32: {:.4f}", spread(fine.spring_drop))});
    return rows;
}

} // namespace weft
