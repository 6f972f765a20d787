#include "experiments/control/joint_errors.h"

#include <algorithm>

namespace halfstep::control {

const std::array<Vector6d, 2>& JointErrors::Integrated(const MeasuredState& measured, double next) {
  constexpr double kAges = 2.5;  // of a measurement; faster, the delay makes it swing
  while (wanted_.size() > 1 && wanted_[1].t <= measured.t) wanted_.pop_front();
  if (gain_ <= 0.0 || wanted_.size() < 2 || wanted_[0].t > measured.t) return integral_;
  const double x = (measured.t - wanted_[0].t) / (wanted_[1].t - wanted_[0].t);
  const double share = kControlPeriod / std::max(time_, kAges * (next - measured.t));
  for (size_t s = 0; s < 2; ++s) {
    const Vector6d wanted = wanted_[0].q[s] + x * (wanted_[1].q[s] - wanted_[0].q[s]);
    // Implicitly: a gain near 0 forgets at once.
    integral_[s] = (integral_[s] + share * (wanted - measured.q[s])) / (1.0 + share / gain_);
  }
  return integral_;
}

}  // namespace halfstep::control
