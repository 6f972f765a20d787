#pragma once

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// How far rounding may carry what is computed of one leg from what the exact leg does in the exact
/// walk. +∞ where nothing can be said: the leg is too nearly stretched for its numbers.
struct LegRounding {
  /// What the sole's pose or twist, seen from the waist, may differ by at the computed angles and
  /// speeds: norms of both halves.
  struct OfSole {
    double turn = 0.0, place = 0.0;  ///< [rad], [m]; of the twist [rad/s], [m/s]
  };
  Vector6d q = Vector6d::Zero();       ///< of each joint angle [rad]
  Vector6d speeds = Vector6d::Zero();  ///< of each joint speed [rad/s]
  double turn = 0.0;          ///< of the direction of an axis or a link, seen from the waist [rad]
  double reach = 0.0;         ///< of LegIkSolution::reach_margin [m]
  double points = 0.0;        ///< of a point of a body of the leg, in W [m]
  double point_speeds = 0.0;  ///< of such a point's velocity [m/s]
  /// Sums of the rows of a bound of |1 − Y J|, Y the computed inverse of the exact Jacobian J.
  Vector6d of_inverse = Vector6d::Zero();
  OfSole pose;   ///< to first order δq = Y·pose
  OfSole twist;  ///< and δq̇ = Y·(twist − H δq), H the derivative of J q̇ by the angles
  /// Of an axis' direction [rad] and a point [m] where they are placed by the computed angles, seen
  /// from the waist.
  double placed_turn = 0.0, placed = 0.0;
  double chain = 0.0;  ///< the way along the leg from B's origin to the sole, in any posture [m]
};

}  // namespace halfstep
