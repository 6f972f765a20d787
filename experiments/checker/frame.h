#pragma once

#include <Eigen/Geometry>
#include <array>

#include "experiments/checker/interval.h"

namespace halfstep::checker {

/// A vector of intervals, or of what else has +, − and ·.
template <typename T>
using VectorIn = std::array<T, 3>;
using Vector = VectorIn<Interval>;  ///< of intervals

/// −v.
template <typename T>
VectorIn<T> operator-(const VectorIn<T>& v) {
  return {-v[0], -v[1], -v[2]};
}
/// a + b.
template <typename T>
VectorIn<T> operator+(const VectorIn<T>& a, const VectorIn<T>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
/// a − b.
template <typename T>
VectorIn<T> operator-(const VectorIn<T>& a, const VectorIn<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
/// That of doubles.
template <typename T = Interval>
VectorIn<T> VectorOf(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// aᵀb.
template <typename T>
T Dot(const VectorIn<T>& a, const VectorIn<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/// The same where one is of doubles.
template <typename T>
T Dot(const Eigen::Vector3d& a, const VectorIn<T>& b) {
  return a.x() * b[0] + a.y() * b[1] + a.z() * b[2];
}
/// a × b.
template <typename T>
VectorIn<T> Cross(const VectorIn<T>& a, const VectorIn<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// The same where one is of doubles.
template <typename T>
VectorIn<T> Cross(const Eigen::Vector3d& a, const VectorIn<T>& b) {
  return {a.y() * b[2] - a.z() * b[1], a.z() * b[0] - a.x() * b[2], a.x() * b[1] - a.y() * b[0]};
}

/// x ↦ R x + p for all R and p of intervals [m].
template <typename T>
struct FrameIn {
  /// Rotation, by rows.
  std::array<VectorIn<T>, 3> R{VectorIn<T>{1.0, 0.0, 0.0}, VectorIn<T>{0.0, 1.0, 0.0},
                               VectorIn<T>{0.0, 0.0, 1.0}};
  VectorIn<T> p{};  ///< origin [m]

  /// A column of R.
  VectorIn<T> Column(size_t k) const { return {R[0][k], R[1][k], R[2][k]}; }
  /// R x.
  VectorIn<T> Turned(const VectorIn<T>& x) const {
    return {Dot(R[0], x), Dot(R[1], x), Dot(R[2], x)};
  }
  /// Rᵀx.
  VectorIn<T> TurnedBack(const VectorIn<T>& x) const {
    return {Dot(Column(0), x), Dot(Column(1), x), Dot(Column(2), x)};
  }
  VectorIn<T> operator*(const VectorIn<T>& x) const { return Turned(x) + p; }  ///< R x + p
  /// First b, then this.
  FrameIn operator*(const FrameIn& b) const {
    FrameIn product;
    for (size_t k = 0; k < 3; ++k) {
      const VectorIn<T> column = Turned(b.Column(k));
      for (size_t i = 0; i < 3; ++i) product.R[i][k] = column[i];
    }
    product.p = *this * b.p;
    return product;
  }
  /// The way back.
  FrameIn Inverse() const {
    FrameIn back;
    for (size_t i = 0; i < 3; ++i) back.R[i] = Column(i);
    back.p = -back.Turned(p);
    return back;
  }
};
using Frame = FrameIn<Interval>;  ///< of intervals

/// A frame of doubles, as a URDF's reader made it.
template <typename T = Interval>
FrameIn<T> FrameOf(const Eigen::Isometry3d& X) {
  FrameIn<T> frame;
  for (int i = 0; i < 3; ++i) {
    const auto row = static_cast<size_t>(i);
    for (int k = 0; k < 3; ++k) frame.R[row][static_cast<size_t>(k)] = X.linear()(i, k);
    frame.p[row] = X.translation()[i];
  }
  return frame;
}

/// The turn about a unit axis through the origin, by the angle's sine and cosine, by Rodrigues'
/// formula.
template <typename T>
FrameIn<T> TurnAbout(const Eigen::Vector3d& axis, const T& sin, const T& cos) {
  const T rest = T(1.0) - cos;
  FrameIn<T> turn;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      turn.R[static_cast<size_t>(i)][static_cast<size_t>(k)] = axis[i] * (axis[k] * rest);
    }
  }
  for (size_t i = 0; i < 3; ++i) {
    const size_t k = (i + 1) % 3;
    const T across = axis[static_cast<Eigen::Index>((i + 2) % 3)] * sin;
    turn.R[i][i] = turn.R[i][i] + cos;
    turn.R[i][k] = turn.R[i][k] - across;
    turn.R[k][i] = turn.R[k][i] + across;
  }
  return turn;
}
/// The same by the angles of an interval [rad].
inline Frame TurnAbout(const Eigen::Vector3d& axis, const Interval& angle) {
  const auto [s, c] = SinCosOf(angle);
  return TurnAbout(axis, s, c);
}

}  // namespace halfstep::checker
