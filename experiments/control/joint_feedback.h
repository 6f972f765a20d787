#pragma once

#include <array>
#include <deque>

#include "experiments/control/tracking_controller.h"

namespace halfstep::control {

/// Makes soft servos follow: an integral of how far joints are behind where they shall be, which is
/// added to the commands. At rest a servo is then as if it were stiffer by a factor.
class JointFeedback {
 public:
  /// `gain`: by how much stiffer at rest, less 1; 0: nothing is added. `time`: of the integral [s],
  /// but never less than 2.5 times as long as a command takes to be seen.
  JointFeedback(double gain, double time) : gain_(gain), time_(time) {}

  /// What is added [rad], after a measurement is known while commands for `next` are made [s].
  /// `planned`: where the joints shall be as long as nothing was noted.
  const std::array<Vector6d, 2>& After(const MeasuredState& measured, double next,
                                       const std::array<Vector6d, 2>& planned);
  /// Where the joints shall be at t [s], which increases [rad].
  void Note(double t, const std::array<Vector6d, 2>& wanted) { wanted_.push_back({t, wanted}); }

 private:
  struct Wanted {
    double t = 0.0;
    std::array<Vector6d, 2> q;
  };
  double gain_, time_;
  std::deque<Wanted> wanted_;  // from the last before the measurement on
  std::array<Vector6d, 2> added_{Vector6d::Zero(), Vector6d::Zero()};
};

}  // namespace halfstep::control
