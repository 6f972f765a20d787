#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Largest difference of two poses' entries.
inline double PoseDifference(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

/// Largest difference of joint angles [rad], turns apart.
inline double AngleDifference(const Vector6d& a, const Vector6d& b) {
  double worst = 0;
  for (int i = 0; i < 6; ++i) {
    worst = std::max(worst, std::abs(std::remainder(a[i] - b[i], 2 * std::numbers::pi)));
  }
  return worst;
}

}  // namespace halfstep
