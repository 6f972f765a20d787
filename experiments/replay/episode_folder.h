#pragma once

#include <filesystem>

#include "experiments/live/live_config.h"
#include "experiments/live/true_world.h"
#include "experiments/replay/reference_motion.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep::replay {

/// What an episode's folder says of what happened.
struct RecordedEpisode {
  LiveConfig config;       ///< what the episode was run with
  WholeRobot robot;        ///< with every link of its URDF
  TrueWorld truth;         ///< how the obstacles really moved
  ReferenceMotion motion;  ///< that was executed, to the end of the walk or of the episode
};

/// Reads config.yaml with its robot and scene, and trajectory.csv. Throws InputError for what is
/// missing or wrong, such as a script that names an obstacle that the scene does not have.
RecordedEpisode ReadEpisode(const std::filesystem::path& folder, const Toolbox& tools = {});

}  // namespace halfstep::replay
