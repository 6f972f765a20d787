#pragma once

#include <string>
#include <vector>

#include "wpg/files/fields.h"

namespace halfstep {

/// The group `replay`: on what simulated robots `halfstep run` plays each certified walk.
/// Documented in experiments/replay.md, "Replay".
struct ReplayConfig {
  int seeds = 8;               ///< simulations, each of which draws what is not known of a robot
  std::vector<double> servos;  ///< K [N m/rad], D [N m s/rad]; empty: those of the robot's size
  std::vector<double> ankle;   ///< the same of a passive bush above each foot; empty: there is none
  bool torque_limits = false;  ///< whether servos give no more than the robot's efforts
  std::string controller = "none";  ///< what moves the robot; "none": servos get the plan itself
};

/// The most that `seeds` may be.
inline constexpr int kMostSeeds = 1000;

/// What there is to say against K and D of a spring; "" if nothing. Empty: there is no spring.
std::string MistakeInSpring(const std::vector<double>& spring);

/// The keys of `replay`.
void DeclareReplay(Fields& fields, ReplayConfig* config);

}  // namespace halfstep
