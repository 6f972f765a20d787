#pragma once

#include <Eigen/Core>

#include "wpg/pose2.h"
#include "wpg/side.h"

namespace halfstep {

/// The quantities that a walk is made of, in the order of WalkVector. Lengths [m], yaws [rad].
/// Feet: sole centres above the floor.
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
using WalkVector = Eigen::Matrix<double, kNumQuantities, 1>;

/// Index of the first of a foot's four quantities (x, y, z, yaw).
constexpr int FootIndex(Side side) { return side == Side::kLeft ? kLeftX : kRightX; }

/// Value, first and second time derivative of all quantities at one instant.
struct WalkJet {
  WalkVector value = WalkVector::Zero();
  WalkVector first = WalkVector::Zero();   ///< [1/s]
  WalkVector second = WalkVector::Zero();  ///< [1/s²]
};

/// Placement of a foot on the floor, X_·F, of a walk vector.
inline Pose2 FootPose(const WalkVector& x, Side side) {
  const int i = FootIndex(side);
  return {x[i], x[i + 1], x[i + 3]};
}

/// The same quantities seen from A instead of S: positions and yaws by X_AS.
inline WalkVector Transformed(const Pose2& X_AS, const WalkVector& x_S) {
  WalkVector x_A = x_S;
  for (int i : {kComX, kZmpX, kLeftX, kRightX}) {
    x_A.segment<2>(i) = X_AS * Eigen::Vector2d(x_S.segment<2>(i));
  }
  for (int i : {kWaistYaw, kLeftYaw, kRightYaw}) x_A[i] += X_AS.yaw;
  return x_A;
}

/// Reflection in the xz plane: y and yaw change sign, left and right change places.
inline WalkVector Mirrored(const WalkVector& x) {
  WalkVector y = x;
  y.segment<4>(kLeftX) = x.segment<4>(kRightX);
  y.segment<4>(kRightX) = x.segment<4>(kLeftX);
  for (int i : {kComY, kZmpY, kWaistYaw, kLeftY, kLeftYaw, kRightY, kRightYaw}) y[i] = -y[i];
  return y;
}

}  // namespace halfstep
