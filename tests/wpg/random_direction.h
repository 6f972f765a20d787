#pragma once

#include <Eigen/Core>
#include <random>

namespace halfstep {

/// A unit vector in any direction, all alike.
inline Eigen::Vector3d RandomDirection(std::mt19937* random) {
  std::normal_distribution<double> normal;
  const double x = normal(*random), y = normal(*random), z = normal(*random);
  return Eigen::Vector3d(x, y, z).normalized();
}

}  // namespace halfstep
