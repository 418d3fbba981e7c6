#pragma once

#include "base/eigen.h"

#include <random>

namespace weft::test {

/// Uniformly random rotation.
inline Mat3 random_rotation(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
        .normalized()
        .toRotationMatrix();
}

} // namespace weft::test
