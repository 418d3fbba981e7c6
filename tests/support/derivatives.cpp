#include "support/derivatives.h"

#include <Eigen/Eigenvalues>

namespace weft::test {

VecX numerical_gradient(const std::function<double(const VecX&)>& f, VecX x, double delta) {
    VecX gradient(x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const double at = x(i);
        x(i) = at + delta;
        const double above = f(x);
        x(i) = at - delta;
        gradient(i) = (above - f(x)) / (2.0 * delta);
        x(i) = at;
    }
    return gradient;
}

MatX numerical_jacobian(const std::function<VecX(const VecX&)>& f, VecX x, double delta) {
    MatX jacobian(f(x).size(), x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const double at = x(i);
        x(i) = at + delta;
        const VecX above = f(x);
        x(i) = at - delta;
        jacobian.col(i) = (above - f(x)) / (2.0 * delta);
        x(i) = at;
    }
    return jacobian;
}

VecX eigenvalues(const MatX& symmetric) {
    return Eigen::SelfAdjointEigenSolver<MatX>(symmetric).eigenvalues();
}

} // namespace weft::test
