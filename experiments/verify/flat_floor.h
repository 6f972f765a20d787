#pragma once

#include <Eigen/Core>

#include "experiments/verify/walk_plan.h"
#include "wpg/check.h"

namespace halfstep::verify {

/// What a walk's feet stand on: one level everywhere. Whatever `verify` says of heights asks this,
/// and not the ground that the prover asks.
class FlatFloor {
 public:
  /// On which every sole of a plan stands. Precondition: there is one height (std::logic_error).
  explicit FlatFloor(const WalkPlan& planned) : height_(planned.start[0].height) {
    CheckOn(planned.start[1]);
    for (const auto& [half_step, X_WS] : planned.half_steps) {
      CheckOn(X_WS);
      CheckOn(X_WS * half_step.X_SF);
    }
  }

  /// Of a point at z in W, how high it is above the floor [m].
  double Above(double z) const { return z - height_; }
  /// The place of a sole that stands at X_WF, seen from above.
  Foothold Sole(const Pose2& X_WF) const { return {X_WF, height_}; }
  /// A point of the floor, in W [m].
  Eigen::Vector3d Point(const Eigen::Vector2d& p_W) const { return {p_W.x(), p_W.y(), height_}; }

 private:
  void CheckOn(const Foothold& X_WF) const {
    HALFSTEP_CHECK(X_WF.height == height_, X_WF.height << " m beside " << height_ << " m");
  }

  double height_;
};

}  // namespace halfstep::verify
