#include "experiments/control/joint_feedback.h"

#include <algorithm>

namespace halfstep::control {

const std::array<Vector6d, 2>& JointFeedback::After(const MeasuredState& measured, double next,
                                                    const std::array<Vector6d, 2>& planned) {
  constexpr double kPeriodsToWait = 2.5;
  if (gain_ <= 0.0) return added_;
  while (wanted_.size() > 1 && wanted_[1].t <= measured.t) wanted_.pop_front();
  std::array<Vector6d, 2> wanted = planned;
  if (wanted_.size() > 1 && wanted_[0].t <= measured.t) {
    const double x = (measured.t - wanted_[0].t) / (wanted_[1].t - wanted_[0].t);
    for (size_t s = 0; s < 2; ++s) {
      wanted[s] = wanted_[0].q[s] + x * (wanted_[1].q[s] - wanted_[0].q[s]);
    }
  }
  const double time = std::max(time_, kPeriodsToWait * (next - measured.t));
  for (size_t s = 0; s < 2; ++s) {
    const Vector6d behind = wanted[s] - measured.q[s];
    // Implicitly: a gain near 0 forgets at once.
    added_[s] = (added_[s] + kControlPeriod / time * behind) / (1.0 + kControlPeriod / (time * gain_));
  }
  return added_;
}

}  // namespace halfstep::control
