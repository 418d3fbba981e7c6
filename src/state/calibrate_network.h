#pragma once

#include "state/cloth.h"

namespace weft {

/// Sets K of sides and diagonals so that the network's response to small strains is nearest to that
/// of the membrane of the cloth's fabric: the same fabric is then equally stiff on any mesh.
///
/// A cell, a triangle or a quad with both its diagonals, strained as a whole, resists like plane
/// stress with C = sum of K_e L_e^2 m_e m_e^T / A, m = (n1^2, n2^2, n1 n2) along the edge; its K,
/// none below a thousandth of the mean, are those with C nearest to the fabric's, where couplings
/// of stretch and shear count a tenth, as they cancel between neighbours. An edge of two cells has
/// the sum of both. (Where edges alone can be exact, so is this; of isotropic triangles with
/// poisson 1/3 it is K_e = 4 L_e^2 sum of k_ii of Kikuuwe et al. 2009 when the triangles are
/// equilateral.) Networks of edges have c12 = c33: what the fabric has else is not met.
///
/// Bending edges stay as they are.
void calibrate_network(const Cloth& cloth, std::span<const Index> polygons, EdgeNetwork& network);

/// Moduli of a network or a fabric for small uniform strains.
struct NetworkModuli {
    Vec2 stretch{0.0, 0.0}; ///< Young's moduli (times thickness) along weft and warp, N/m
    double shear = 0.0;     ///< N/m
};

/// Moduli of the sides and diagonals of a cloth's network, averaged over its area. They are exact
/// for a regular mesh and an upper bound for an irregular one, whose vertices may give way.
NetworkModuli network_moduli(const Cloth& cloth);

/// `stretch 2.1 % (weft), -0.5 % (warp), shear -12 %`: a calibrated network against its fabric.
std::string calibration_error_text(const Cloth& cloth);

} // namespace weft
