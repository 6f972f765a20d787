#pragma once

#include <array>
#include <deque>

#include "experiments/control/tracking_controller.h"

namespace halfstep::control {

/// The integral of how far joints are from where they shall be. Added to the commands, it makes a
/// servo at rest as if it were stiffer by a factor.
class JointErrors {
 public:
  /// `gain`: that factor less 1; not above 0: the integral stays 0. `time`: of the integral [s],
  /// but never less than 2.5 times as long as a command takes to be seen.
  JointErrors(double gain, double time) : gain_(gain), time_(time) {}

  /// Takes a measurement in, while commands for the time `next` [s] are made. Returns the integral
  /// [rad].
  const std::array<Vector6d, 2>& Integrated(const MeasuredState& measured, double next);
  /// Where the joints shall be at t [s], which increases [rad].
  void Note(double t, const std::array<Vector6d, 2>& wanted) { wanted_.push_back({t, wanted}); }

 private:
  struct Wanted {
    double t = 0.0;
    std::array<Vector6d, 2> q;
  };
  double gain_, time_;
  std::deque<Wanted> wanted_;  // from the last before the measurement on
  std::array<Vector6d, 2> integral_{Vector6d::Zero(), Vector6d::Zero()};
};

}  // namespace halfstep::control
