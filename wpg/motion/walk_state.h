#pragma once

#include <Eigen/Core>

#include "wpg/geometry/foothold.h"
#include "wpg/geometry/pose2.h"
#include "wpg/geometry/side.h"
#include "wpg/motion/quantity.h"

namespace halfstep {

/// One value of each quantity (14×1), or a change of each: lengths [m], yaws [rad].
using WalkState = Eigen::Matrix<double, kNumQuantities, 1>;

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

/// The same quantities seen from A, S standing in it at a height: positions and yaws by X_AS.
inline WalkState Transformed(const Foothold& X_AS, const WalkState& x_S) {
  const Pose2 planar = X_AS.Planar();
  WalkState x_A = x_S;
  for (const QuantityTraits& row : kQuantities) {
    const int q = row.quantity;
    if (row.component == Component::kX) {
      x_A.segment<2>(q) = planar * Eigen::Vector2d(x_S.segment<2>(q));
    } else if (row.component == Component::kZ) {
      x_A[q] += X_AS.height;
    } else if (row.component == Component::kYaw) {
      x_A[q] += X_AS.yaw;
    }
  }
  return x_A;
}

/// A change of the quantities, seen from A: horizontal ones turn by R_AS (2×2).
inline WalkState Turned(const Eigen::Matrix2d& R_AS, const WalkState& change_S) {
  WalkState change_A = change_S;
  for (const QuantityTraits& row : kQuantities) {
    const int q = row.quantity;
    if (row.component == Component::kX) change_A.segment<2>(q) = R_AS * change_S.segment<2>(q);
  }
  return change_A;
}

/// Reflection in the xz plane: y and yaw change sign, left and right change places.
inline WalkState Mirrored(const WalkState& x) {
  WalkState y;
  for (const QuantityTraits& row : kQuantities) {
    const bool flips = row.component == Component::kY || row.component == Component::kYaw;
    y[row.mirrored] = flips ? -x[row.quantity] : x[row.quantity];
  }
  return y;
}

}  // namespace halfstep
