#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "experiments/checker/taylor.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::checker {

/// A leg in motion.
struct LegPosture {
  std::array<Curve, 6> q;                 ///< joint angles [rad]
  std::array<FrameIn<Curve>, 6> X_WLink;  ///< frames of the links
};

class OffsetLeg;

/// Inverse kinematics of a leg in the branch of its standing posture, of functions of time: in
/// closed form, or where axes of hip or ankle miss each other by OffsetLeg. Source: wpg/README.md,
/// "Leg inverse kinematics", whose symbols these are.
class LegSolver {
 public:
  /// Borrows the leg.
  explicit LegSolver(const Leg& leg);

  /// Frame of W where the sole was at q = 0, carried by the sole: X_WSole·X_BSole(0)⁻¹.
  FrameIn<Curve> Carried(const FrameIn<Curve>& X_WSole) const { return X_WSole * X_SoleB_; }
  /// Stretched length − hip–ankle distance [m] of a leg with a closed form.
  Curve Reach(const FrameIn<Curve>& X_WB, const FrameIn<Curve>& carried) const;
  /// The same of any leg, by its knee's angle [rad].
  Curve Reach(const Curve& knee) const;
  /// Has to come before At for a leg without closed form: OffsetLeg::Follow.
  void Follow(const std::vector<double>& knots,
              const std::function<FrameIn<Curve>(double from, double to)>& foot);
  /// On [from, to], for an upright waist and a sole that has carried the zero posture there. Throws
  /// NotDefined where a singularity is not excluded.
  LegPosture At(const FrameIn<Curve>& X_WB, const FrameIn<Curve>& carried, double from,
                double to) const;

 private:
  const Leg& leg_;
  std::shared_ptr<OffsetLeg> offset_;  // null: it has a closed form
  FrameIn<Curve> X_SoleB_;
  Vector hip_, ankle_;                                     // seen from a point on the knee's axis
  Interval along_, levers_;                                // a∥ − h∥, r_h r_a
  Interval squares_;                                       // (a∥ − h∥)² + r_h² + r_a²
  Interval sin_zero_, cos_zero_;                           // of ψ_0
  double knee_ = 1.0, ankle_side_ = 1.0, hip_side_ = 1.0;  // signs of the branch
};

}  // namespace halfstep::checker
