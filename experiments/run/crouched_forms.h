#pragma once

#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/config/half_step_config.h"

namespace halfstep {

/// A form of half-steps for passing under what hangs too low for the standing robot.
struct CrouchedForm {
  HalfStepConfig half_step;  ///< lower, and with feet that rise less where legs ask for that
  int places = 0;            ///< of the config's step set that are certified
  std::string reason;        ///< "'beam' hangs 1.450 m above the floor, where half-steps …"
};

/// What of a place lies over the walk, so low that the robot does not pass upright, and whether a
/// crouch may help. Only obstacles that rest count, and what is no more than four steps of 5 cm
/// (HRP-2; by leg length) too low.
class Overhead {
 public:
  /// Both are borrowed.
  Overhead(const ExperimentConfig& config, const Place& place);

  /// Whether a crouch may help with some of it.
  bool may_help() const { return !steps_.empty(); }
  /// Whether it bars the way to the goal, as far as a slim upright column tells that is moved over
  /// the floor among all that rests. A guess: it says what to search first.
  bool Bars() const;
  /// The forms with which the robot passes under all that a crouch lets it pass under, and then
  /// under all but the lowest; at most two. Of one crouch the form with the highest via point by
  /// which a fifth of the step set's places are certified, else that with most.
  std::vector<CrouchedForm> Forms() const;

 private:
  CrouchedForm FormOf(int step) const;

  const ExperimentConfig& config_;
  const Place& place_;
  double top_ = 0.0;        // of the standing robot [m]
  double room_ = 0.0;       // above it, that half-steps need [m]
  std::vector<int> steps_;  // of crouch that help with something, ascending
};

/// "'beam' hangs 1.450 m above the floor, where half-steps upright need 1.512 m", where it is so
/// low and begins above the half of the robot; else "". `clearance` is what they keep [m].
std::string HangsTooLow(const Obstacle& obstacle, const RobotModel& robot, double clearance);

}  // namespace halfstep
