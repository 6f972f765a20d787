#pragma once

#include <Eigen/Geometry>
#include <array>
#include <utility>

#include "tests/oracle/real.h"

namespace halfstep::oracle {

using Real3 = std::array<Real, 3>;
using Real33 = std::array<Real3, 3>;  ///< rows
using Real6 = std::array<Real, 6>;

inline Real Absolute(Real x) { return x < 0 ? -x : x; }
inline Real3 From(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Real3 operator+(const Real3& a, const Real3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Real3 operator-(const Real3& a, const Real3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Real3 operator*(Real s, const Real3& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline Real Dot(const Real3& a, const Real3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Real3 Cross(const Real3& a, const Real3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Real3 operator*(const Real33& R, const Real3& x) {
  return {Dot(R[0], x), Dot(R[1], x), Dot(R[2], x)};
}
inline Real33 Transposed(const Real33& A) {
  Real33 T;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) T[i][j] = A[j][i];
  }
  return T;
}
inline Real33 operator*(const Real33& A, const Real33& B) {
  const Real33 T = Transposed(B);
  Real33 C;
  for (size_t i = 0; i < 3; ++i) C[i] = {Dot(A[i], T[0]), Dot(A[i], T[1]), Dot(A[i], T[2])};
  return C;
}
inline Real Norm(const Real3& a) { return Sqrt(Dot(a, a)); }
inline const Real33 kIdentity = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// By Rodrigues, about a unit vector.
inline Real33 Rotation(const Real3& axis, Real angle) {
  const Real c = Cos(angle), s = Sin(angle);
  Real33 R;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) R[i][j] = (1 - c) * axis[i] * axis[j] + (i == j ? c : Real(0));
  }
  R[0][1] -= s * axis[2];
  R[1][0] += s * axis[2];
  R[0][2] += s * axis[1];
  R[2][0] -= s * axis[1];
  R[1][2] -= s * axis[0];
  R[2][1] += s * axis[0];
  return R;
}
inline Real33 Yawed(Real yaw) { return Rotation({0, 0, 1}, yaw); }

inline Real33 FromMatrix(const Eigen::Matrix3d& A) {
  Real33 R;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      R[i][j] = A(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
  return R;
}

/// A⁻¹ b, by Gauss with pivots.
inline Real6 Solved(std::array<Real6, 6> A, Real6 b) {
  for (size_t k = 0; k < 6; ++k) {
    size_t pivot = k;
    for (size_t i = k; i < 6; ++i) {
      if (Absolute(A[i][k]) > Absolute(A[pivot][k])) pivot = i;
    }
    std::swap(A[k], A[pivot]);
    std::swap(b[k], b[pivot]);
    for (size_t i = k + 1; i < 6; ++i) {
      const Real factor = A[i][k] / A[k][k];
      for (size_t j = k; j < 6; ++j) A[i][j] -= factor * A[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (size_t k = 6; k-- > 0;) {
    for (size_t j = k + 1; j < 6; ++j) b[k] -= A[k][j] * b[j];
    b[k] /= A[k][k];
  }
  return b;
}

}  // namespace halfstep::oracle
