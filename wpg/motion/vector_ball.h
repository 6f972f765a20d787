#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

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
/// that their operands contain, but for rounding.
struct VectorBall {
  Eigen::Vector3d center{0, 0, 0};  ///< any vector
  double radius = 0.0;              ///< ≥ 0

  double most() const { return center.norm() + radius; }  ///< sup ‖x‖

  /// All sums of a vector of each.
  VectorBall& operator+=(const VectorBall& b) {
    center += b.center;
    radius += b.radius;
    return *this;
  }
  /// All sums of a vector of each.
  friend VectorBall operator+(VectorBall a, const VectorBall& b) { return a += b; }
  /// All differences of a vector of each.
  friend VectorBall operator-(const VectorBall& a, const VectorBall& b) {
    return {a.center - b.center, a.radius + b.radius};
  }
  /// Every vector times a number.
  friend VectorBall operator*(double x, const VectorBall& a) {
    return {x * a.center, std::abs(x) * a.radius};
  }
  /// All products of a number and a vector of each.
  friend VectorBall operator*(const Range& x, const VectorBall& a) {
    return {x.center * a.center, std::abs(x.center) * a.radius + x.radius * a.most()};
  }
};

/// All cross products of a vector of each.
inline VectorBall Cross(const VectorBall& a, const VectorBall& b) {
  return {a.center.cross(b.center),
          a.center.norm() * b.radius + a.radius * (b.center.norm() + b.radius)};
}

}  // namespace halfstep
