#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/config/replay_config.h"
#include "experiments/control/controllers.h"
#include "experiments/replay/seeded_replay.h"

namespace halfstep::replay {

/// A simulated robot and what moves it, as options of `halfstep replay` and `halfstep live` say it.
struct SimulatedRobot {
  ReplayConfig robot;                ///< servos, ankles, torque limits; `seeds` is not used
  std::optional<std::string> floor;  ///< as ParseRelief() takes it; none: level
  /// What moves the robot, by its name in `controllers`; "none": the servos get the plan itself.
  std::optional<std::string> controller = {};
  std::optional<double> sensor_delay = {};        ///< SensorOptions::delay [s]
  std::optional<std::uint64_t> sensor_seed = {};  ///< SensorOptions::seed
  control::Controllers controllers =
      control::Controllers::Standard();  ///< that `controller` may name

  /// The robot in a world. Throws InputError for what no robot or controller can do with, and for a
  /// floor that uneven ground does not have.
  ReplaySetup SetupOf(WholeRobot whole, const SimulatedObstacles& world) const;
};

}  // namespace halfstep::replay
