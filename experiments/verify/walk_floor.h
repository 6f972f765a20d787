#pragma once

#include "experiments/verify/walk_plan.h"
#include "wpg/check.h"

namespace halfstep::verify {

/// The floor below a walk, under which all is solid. Whatever `verify` says of heights above it
/// asks this, and not the ground that the prover asks.
class WalkFloor {
 public:
  /// At z = `height` in W [m]; −∞: there is none.
  explicit WalkFloor(double height) : height_(height) {}
  /// The one level on which every sole of a plan stands. Precondition: there is one height
  /// (std::logic_error).
  explicit WalkFloor(const WalkPlan& planned) : height_(planned.start[0].height) {
    CheckOn(planned.start[1]);
    for (const auto& [half_step, X_WS, rest] : planned.half_steps) {
      CheckOn(X_WS);
      CheckOn(X_WS * half_step.X_SF);
    }
  }

  /// Of a point at z in W, how high it is above the floor [m].
  double Above(double z) const { return z - height_; }

 private:
  void CheckOn(const Foothold& X_WF) const {
    HALFSTEP_CHECK(X_WF.height == height_, X_WF.height << " m beside " << height_ << " m");
  }

  double height_;
};

}  // namespace halfstep::verify
