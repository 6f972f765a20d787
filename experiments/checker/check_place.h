#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/checker/check_trajectory.h"

namespace halfstep::checker {

/// What trajectories are checked in, as files have it.
struct CheckPlace {
  JointedRobot robot;                                         ///< that moves
  Scene scene = {};                                           ///< obstacles
  bool has_scene = false;                                     ///< whether a scene was given
  std::vector<std::pair<std::string, std::string>> excluded;  ///< links, by the robot file
};

/// Reads a URDF, a robot file or a shipped robot, by its name, whose meshes are in `packages` too
/// (name → folder), and a scene file or a shipped scene; "": none. Throws InputError.
CheckPlace ReadCheckPlace(const std::string& robot, const std::string& scene,
                          const std::map<std::string, std::string>& packages);

/// CheckTrajectory in that place, where nothing is asked of excluded pairs; what is not looked at
/// is all told.
TrajectoryCheck CheckIn(const CheckPlace& place, const Trajectory& trajectory,
                        TrajectoryDemands demands,
                        const std::function<bool(double done)>& progress = {});

}  // namespace halfstep::checker
