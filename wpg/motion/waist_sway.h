#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "wpg/motion/profile_jet.h"
#include "wpg/motion/vector_ball.h"

namespace halfstep {

/// A small horizontal motion of the waist that a half-step adds to its CoM, in S [m]:
///
///     d(τ) = Σ_k controls[k]·B(12·τ/T − k),
///
/// B the cubic B-spline on [0, 4]. So d is C², it is zero with its first and second derivatives at
/// both ends, and d⃛ is constant on each twelfth of T. The form does not depend on T: where T
/// varies, d(σ) stays and goes faster or slower. Source: wpg/README.md, "Compensation".
struct WaistSway {
  static constexpr int kPieces = 12;  ///< pieces of a half-step, each T/12 long
  /// Numbers of B-splines that begin and end at rest.
  static constexpr int kControls = kPieces - 3;

  std::vector<Eigen::Vector2d> controls;  ///< kControls of them [m], or none: no motion

  bool none() const { return controls.empty(); }  ///< whether there is no motion
  /// The motion along x and y at local time τ [s] of a half-step that lasts T = `duration` [s],
  /// with derivatives as those of a profile, in metres; zero before 0 and after T.
  std::array<ProfileJet, 2> At(double tau, double duration) const;
  /// sup |d̈| along x and y over local times [from, to] [m/s²]: exact.
  Eigen::Vector2d SecondBound(double from, double to, double duration) const;
  /// All values of the third derivative along x and y over local times [from, to] [m/s³]: exact,
  /// but that a piece counts which the interval touches.
  std::array<Range, 2> ThirdRange(double from, double to, double duration) const;

  /// The same motion turned by `R`, reflected in the xz plane, and multiplied.
  WaistSway Turned(const Eigen::Matrix2d& R) const;
  WaistSway Mirrored() const;             ///< reflected: y changes its sign
  WaistSway Scaled(double factor) const;  ///< times a factor

  friend bool operator==(const WaistSway&, const WaistSway&) = default;
};

/// Value, slope and curvature of the cubic B-spline on [0, 4] at u; 0 elsewhere.
Eigen::Vector3d CubicBSpline(double u);

}  // namespace halfstep
