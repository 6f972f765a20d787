#pragma once

#include <optional>

#include "experiments/control/controllers.h"
#include "experiments/control/dcm_error.h"

namespace halfstep::control {

/// Watches how far a robot's DCM is off its plan (DcmError): when it is farther than the soles can
/// bring it back from, the robot was pushed.
class PushWatch {
 public:
  /// A ZMP in the middle of one sole brings the DCM back from within the sole; half of that is left
  /// for where the planned ZMP is beside the middle. Shares of the sole's length and width, in the
  /// robot's frame.
  static constexpr double kPushed = 0.25;
  static constexpr double kBack = 0.125;  ///< when the robot no longer counts as pushed

  /// Borrows the robot's model.
  explicit PushWatch(const ControlledRobot& robot);

  /// Takes a measurement in, `period` [s] after the one before; `then` was planned for measured.t.
  /// How far off the DCM is [m], when the robot has just been found pushed; else none.
  std::optional<double> Look(const MeasuredState& measured, const PlannedState& then,
                             double period);
  bool pushed() const { return pushed_; }  ///< since then, until the DCM is back

 private:
  Eigen::Vector2d sole_size_;
  DcmError dcm_;
  bool pushed_ = false;
};

}  // namespace halfstep::control
