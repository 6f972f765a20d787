#include "experiments/control/sensors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wpg/elementary.h"
#include "wpg/geometry/rotation.h"

namespace halfstep::control {

// Box and Muller's; std::normal_distribution differs by library.
double Sensors::Normal(double deviation) {
  constexpr double kUnit = 0x1p-53;
  const double u = (static_cast<double>(random_() >> 11) + 0.5) * kUnit;
  const double v = static_cast<double>(random_() >> 11) * kUnit;
  return deviation * std::sqrt(-2.0 * Log(u)) * Cos(2.0 * std::numbers::pi * v);
}

MeasuredState Sensors::Measured(MeasuredState state) {
  if (!options_.seed) return state;
  for (size_t s = 0; s < 2; ++s) {
    for (Eigen::Index j = 0; j < 6; ++j) {
      state.q[s][j] += Normal(options_.angle);
      state.speeds[s][j] += Normal(options_.speed);
    }
    SoleLoad& load = state.loads[s];
    if (!(load.force > 0.0)) continue;
    load.force = std::max(0.0, load.force + Normal(options_.force * weight_));
    for (double& place : load.centre) place += Normal(options_.centre);
  }
  for (double& rate : state.turn_B) rate += Normal(options_.turn);
  const double roll = Normal(options_.tilt), pitch = Normal(options_.tilt);
  state.R_WB = RollPitchYaw(roll, pitch, Normal(options_.tilt)) * state.R_WB;
  return state;
}

}  // namespace halfstep::control
