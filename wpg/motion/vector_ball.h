#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "wpg/rounded.h"

namespace halfstep {

/// All numbers within `radius` of `center`.
struct Range {
  double center = 0.0;  ///< any number
  double radius = 0.0;  ///< ≥ 0

  /// The numbers of [low, high].
  static Range Between(double low, double high) { return {0.5 * (low + high), 0.5 * (high - low)}; }
  double most() const { return std::abs(center) + radius; }  ///< sup |x|
};

/// All vectors within `radius` of `center`. Sums and products contain the sums and products of all
/// that their operands contain, the rounding of centres included.
struct VectorBall {
  Eigen::Vector3d center{0, 0, 0};  ///< any vector
  double radius = 0.0;              ///< ≥ 0

  double most() const { return center.norm() + radius; }  ///< sup ‖x‖

  /// All sums of a vector of each.
  VectorBall& operator+=(const VectorBall& b) {
    center += b.center;
    radius += b.radius + OfSum(center);
    return *this;
  }
  /// All sums of a vector of each.
  friend VectorBall operator+(VectorBall a, const VectorBall& b) { return a += b; }
  /// All differences of a vector of each.
  friend VectorBall operator-(const VectorBall& a, const VectorBall& b) {
    const Eigen::Vector3d center = a.center - b.center;
    return {center, a.radius + b.radius + OfSum(center)};
  }
  /// Every vector times a number.
  friend VectorBall operator*(double x, const VectorBall& a) {
    const Eigen::Vector3d center = x * a.center;
    return {center, std::abs(x) * a.radius + OfSum(center)};
  }
  /// All products of a number and a vector of each.
  friend VectorBall operator*(const Range& x, const VectorBall& a) {
    const Eigen::Vector3d center = x.center * a.center;
    return {center, std::abs(x.center) * a.radius + x.radius * a.most() + OfSum(center)};
  }

 private:
  // What one operation on each component may round by, and more.
  static double OfSum(const Eigen::Vector3d& x) { return 2.0 * kRoundoff * x.cwiseAbs().sum(); }
};

/// All cross products of a vector of each.
inline VectorBall Cross(const VectorBall& a, const VectorBall& b) {
  const double size_a = a.center.norm(), size_b = b.center.norm();
  return {a.center.cross(b.center),
          size_a * b.radius + a.radius * (size_b + b.radius) + 4.0 * kRoundoff * size_a * size_b};
}

}  // namespace halfstep
