#pragma once

#include <array>
#include <optional>
#include <string>

#include "experiments/survey/climbed_stairs.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// What a config begins with.
struct StarterConfig {
  std::string robot_file;      ///< the robot's file or name, as the config shall name it
  std::string scene = "none";  ///< the scene's, likewise; none: an empty floor
  /// Where to go, x and y in W [m]; none: six steps straight ahead (SixSteps).
  std::optional<std::array<double, 2>> goal = {};
  /// Stairs up which the footsteps go, of the scene (StairsSceneText), and the half-steps' form;
  /// none: `goal`, or straight ahead.
  std::optional<ClimbedStairs> stairs = {};
  /// What the robot cannot do, as a sentence without its subject, so that a search is asked for a
  /// walk; "": it can make one half-step after the other.
  std::string why_search = {};
};

/// Text of a config to begin with: its robot and scene, footsteps or a goal, and in comments the
/// keys that one changes first, with the values that hold for this robot.
std::string StarterConfigText(const RobotModel& robot, const StarterConfig& config);

/// Text of a scene file with that flight.
std::string StairsSceneText(const Flight& flight);

}  // namespace halfstep
