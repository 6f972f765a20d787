#pragma once

#include <Eigen/Core>

#include "wpg/geometry/foothold.h"
#include "wpg/geometry/pose2.h"
#include "wpg/geometry/side.h"

namespace halfstep {

/// The quantities that a walk is made of, in the order of WalkState. Lengths [m], yaws [rad].
/// Feet: sole centres; z is up from the plane z = 0 of the frame in which they are seen.
enum Quantity : int {
  kComX,
  kComY,
  kZmpX,
  kZmpY,
  kWaistYaw,
  kLeftX,
  kLeftY,
  kLeftZ,
  kLeftYaw,
  kRightX,
  kRightY,
  kRightZ,
  kRightYaw,
  kNumQuantities
};

/// One value of each quantity (13×1).
using WalkState = Eigen::Matrix<double, kNumQuantities, 1>;

/// Index of the first of a foot's four quantities (x, y, z, yaw).
constexpr int FootIndex(Side side) { return side == Side::kLeft ? kLeftX : kRightX; }

/// Value, first and second time derivative of all quantities at one instant.
struct WalkJet {
  WalkState value = WalkState::Zero();   ///< by Quantity: [m], or [rad] of yaws
  WalkState first = WalkState::Zero();   ///< [unit/s]
  WalkState second = WalkState::Zero();  ///< [unit/s²]
};

/// The pose of a foot seen from above, in the frame in which `x` is expressed.
inline Pose2 FootPose(const WalkState& x, Side side) {
  const int i = FootIndex(side);
  return {x[i], x[i + 1], x[i + 3]};
}

/// The same quantities seen from A instead of S: positions and yaws by X_AS.
inline WalkState Transformed(const Pose2& X_AS, const WalkState& x_S) {
  WalkState x_A = x_S;
  for (int i : {kComX, kZmpX, kLeftX, kRightX}) {
    x_A.segment<2>(i) = X_AS * Eigen::Vector2d(x_S.segment<2>(i));
  }
  for (int i : {kWaistYaw, kLeftYaw, kRightYaw}) x_A[i] += X_AS.yaw;
  return x_A;
}

/// The same quantities seen from A, S standing in it at a height.
inline WalkState Transformed(const Foothold& X_AS, const WalkState& x_S) {
  WalkState x_A = Transformed(X_AS.Planar(), x_S);
  for (int i : {kLeftZ, kRightZ}) x_A[i] += X_AS.height;
  return x_A;
}

/// Reflection in the xz plane: y and yaw change sign, left and right change places.
inline WalkState Mirrored(const WalkState& x) {
  WalkState y = x;
  y.segment<4>(kLeftX) = x.segment<4>(kRightX);
  y.segment<4>(kRightX) = x.segment<4>(kLeftX);
  for (int i : {kComY, kZmpY, kWaistYaw, kLeftY, kLeftYaw, kRightY, kRightYaw}) y[i] = -y[i];
  return y;
}

}  // namespace halfstep
