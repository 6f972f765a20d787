#pragma once

#include <cstdint>
#include <optional>
#include <random>

#include "experiments/control/tracking_controller.h"

namespace halfstep::control {

/// How a robot's sensors differ from the truth. Noises are standard deviations of a normal
/// distribution, drawn anew for each number and each instant.
struct SensorOptions {
  double delay = 0.005;               ///< what is measured arrives so late [s]; in whole time steps
  std::optional<std::uint64_t> seed;  ///< of the noise; none: there is no noise
  double angle = 1e-4;                ///< of encoders [rad]
  double speed = 0.02;                ///< of joint speeds [rad/s]
  double tilt = 0.002;                ///< of the IMU's orientation, about each axis [rad]
  double turn = 0.005;                ///< of the gyroscopes [rad/s]
  double force = 0.01;                ///< of a sole's force, share of the robot's weight
  double centre = 0.002;              ///< of a sole's centre of pressure [m]
};

/// The sensors of a robot: what they say of a true state.
class Sensors {
 public:
  /// `weight` of the robot [N].
  Sensors(const SensorOptions& options, double weight)
      : options_(options), weight_(weight), random_(options.seed.value_or(0)) {}

  double delay() const { return options_.delay; }  ///< [s]
  /// A true state with noise. The same calls in the same order give the same numbers.
  MeasuredState Measured(MeasuredState state);

 private:
  double Normal(double deviation);

  SensorOptions options_;
  double weight_;
  std::mt19937_64 random_;
};

}  // namespace halfstep::control
