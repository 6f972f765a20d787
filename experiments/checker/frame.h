#pragma once

#include <Eigen/Geometry>
#include <array>

#include "experiments/checker/interval.h"

namespace halfstep::checker {

/// A vector of intervals.
using Vector = std::array<Interval, 3>;
/// A matrix of intervals, by rows.
using Matrix = std::array<Vector, 3>;

/// −v.
inline Vector operator-(const Vector& v) { return {-v[0], -v[1], -v[2]}; }
/// That of doubles.
inline Vector VectorOf(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// aᵀb.
inline Interval Dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// x ↦ R x + p for all R and p of intervals [m].
struct Frame {
  Matrix R{Vector{1.0, 0.0, 0.0}, Vector{0.0, 1.0, 0.0}, Vector{0.0, 0.0, 1.0}};  ///< rotation
  Vector p{};                                                                     ///< origin [m]
};

/// A frame of doubles, as a URDF's reader made it.
inline Frame FrameOf(const Eigen::Isometry3d& X) {
  Frame frame;
  for (int i = 0; i < 3; ++i) {
    const auto row = static_cast<size_t>(i);
    for (int k = 0; k < 3; ++k) frame.R[row][static_cast<size_t>(k)] = X.linear()(i, k);
    frame.p[row] = X.translation()[i];
  }
  return frame;
}

/// First b, then a.
inline Frame operator*(const Frame& a, const Frame& b) {
  Frame product;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 3; ++k) {
      product.R[i][k] = Dot(a.R[i], {b.R[0][k], b.R[1][k], b.R[2][k]});
    }
    product.p[i] = Dot(a.R[i], b.p) + a.p[i];
  }
  return product;
}

/// The turn about a unit axis by the angles of an interval [rad], by Rodrigues' formula.
inline Frame TurnAbout(const Eigen::Vector3d& axis, const Interval& angle) {
  const auto [s, c] = SinCosOf(angle);
  const Interval rest = Interval(1.0) - c;
  const Vector a = VectorOf(axis);
  Frame turn;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 3; ++k) turn.R[i][k] = rest * a[i] * a[k];
    turn.R[i][i] = turn.R[i][i] + c;
  }
  for (size_t i = 0; i < 3; ++i) {
    const size_t k = (i + 1) % 3, l = (i + 2) % 3;
    turn.R[i][k] = turn.R[i][k] - s * a[l];
    turn.R[k][i] = turn.R[k][i] + s * a[l];
  }
  return turn;
}

}  // namespace halfstep::checker
