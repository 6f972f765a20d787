#pragma once

#include <Eigen/Core>
#include <cmath>

#include "wpg/elementary.h"

namespace halfstep {

/// A rotation angle as (cos, sin): composed and applied without trigonometric calls.
struct Turn {
  double cos = 1.0;  ///< of the angle
  double sin = 0.0;  ///< of the angle

  /// From an angle [rad].
  static Turn FromAngle(double angle) {
    const SineCosine both = SinCos(angle);
    return {both.cos, both.sin};
  }
  /// (x, y) need not be normalized; (0, 0), where every angle will do, gives 0.
  static Turn FromDirection(double x, double y) {
    const double norm = std::sqrt(x * x + y * y);
    return norm > 0 ? Turn{x / norm, y / norm} : Turn{};
  }
  double angle() const { return Atan2(sin, cos); }  ///< [rad] in (−π, π]
  Turn Inverse() const { return {cos, -sin}; }      ///< by the negative angle
  /// By the sum of both angles.
  Turn operator*(const Turn& other) const {
    return {cos * other.cos - sin * other.sin, sin * other.cos + cos * other.sin};
  }
};

/// v turned about the unit `axis` through the origin (Rodrigues).
inline Eigen::Vector3d Rotate(const Eigen::Vector3d& axis, const Turn& turn,
                              const Eigen::Vector3d& v) {
  return turn.cos * v + turn.sin * axis.cross(v) + ((1 - turn.cos) * axis.dot(v)) * axis;
}

/// The turn about the unit `axis` that brings the direction of `from` to that of `to`, both seen
/// along the axis. Source: [Murray1994] §3.3.2, subproblem 1.
inline Turn TurnFromTo(const Eigen::Vector3d& axis, const Eigen::Vector3d& from,
                       const Eigen::Vector3d& to) {
  return Turn::FromDirection(from.dot(to) - axis.dot(from) * axis.dot(to),
                             axis.dot(from.cross(to)));
}

/// Turns with R(axis1, first)·R(axis2, second)·from = to, for unit, not parallel axes through the
/// origin and |from| = |to|. `side` (+1 or −1) is the side of the plane of the axes, by the sign of
/// (axis1 × axis2)·x, on which x = R(axis2, second)·from lies: the two-fold choice. Returns false
/// when there is no solution. Source: [Murray1994] §3.3.2, subproblem 2.
[[nodiscard]] inline bool TwoTurnsFromTo(const Eigen::Vector3d& axis1, const Eigen::Vector3d& axis2,
                                         const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                         double side, Turn* first, Turn* second) {
  // Rounding may put a just reachable pose this far outside, relative to |from|².
  constexpr double kSlack = 1e-12;
  const Eigen::Vector3d across = axis1.cross(axis2);
  const double d = axis1.dot(axis2), across2 = across.squaredNorm();
  const double on1 = axis1.dot(to), on2 = axis2.dot(from);
  const double alpha = (on1 - d * on2) / across2, beta = (on2 - d * on1) / across2;
  const double length2 = from.squaredNorm();
  const double rest = length2 - alpha * alpha - beta * beta - 2 * alpha * beta * d;
  if (rest < -kSlack * length2) return false;
  const double gamma = side * std::sqrt(std::max(rest, 0.0) / across2);
  const Eigen::Vector3d between = alpha * axis1 + beta * axis2 + gamma * across;
  *first = TurnFromTo(axis1, between, to);
  *second = TurnFromTo(axis2, from, between);
  return true;
}

}  // namespace halfstep
