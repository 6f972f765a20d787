#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/config/toolbox.h"
#include "experiments/replay/reference_motion.h"
#include "experiments/replay/simulated_obstacles.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep::replay {

/// A walk of a run as the servos follow it.
struct RecordedWalk {
  std::string method;      ///< that smoothed it; "episode"
  std::string folder;      ///< of its tables in the run, with a slash; "": the run itself
  ReferenceMotion motion;  ///< of its trajectory.csv
};

/// What a run folder says of its robot, place and walks.
struct RecordedRun {
  WholeRobot robot;                 ///< with all links
  SimulatedObstacles world;         ///< of its scene
  std::vector<RecordedWalk> walks;  ///< raw first
};

/// Reads a run folder whose config may name what `tools` hold; only `method` when it is given.
/// Throws InputError.
RecordedRun ReadRun(const std::string& run, const std::optional<std::string>& method,
                    const Toolbox& tools);

}  // namespace halfstep::replay
