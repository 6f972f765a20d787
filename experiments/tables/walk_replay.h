#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>

namespace halfstep {

struct Experiment;

/// How a walk went on simulated robots, by the config's group `replay`.
struct WalkReplay {
  int stands = 0;            ///< simulations in which the robot stayed up
  int seeds = 0;             ///< all simulations
  double median_tilt = 0.0;  ///< of the largest tilts of the waist [rad]

  /// "8 of 8"
  std::string Standing() const { return std::to_string(stands) + " of " + std::to_string(seeds); }
};

/// Plays the walk of a trajectory.csv, given as its text; none when it was stopped.
using WalkReplayer = std::function<std::optional<WalkReplay>(
    const Experiment& experiment, const std::string& trajectory, const std::stop_token& stop)>;

}  // namespace halfstep
