#pragma once

#include "geometry/sheet.h"

#include <Eigen/SparseCore>

namespace weft {

/// What a tensile test returns.
struct Elasticity {
    double modulus; ///< E, N/m
    double poisson; ///< nu
};

/// Small uniaxial extension of a unit square along x: its left and right sides are moved apart and
/// slide freely along themselves, the others are free.
///
/// @param stiffness  3 #V squared, N/m, of any model of the sheet; z is not used
Elasticity tensile_test(const Sheet& sheet, const Eigen::SparseMatrix<double>& stiffness);

} // namespace weft
