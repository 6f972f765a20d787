#pragma once

#include <string>

#include "experiments/checker/check_trajectory.h"

namespace halfstep::checker {

/// What was found, for the screen: `title`, a line a kind, and one for each subject that is not
/// proved.
std::string CheckScreen(const std::string& title, const TrajectoryCheck& check);
/// Of a trajectory.
std::string TitleOf(const Trajectory& trajectory);
/// What was found as one JSON object, with every finding.
std::string CheckJson(const Trajectory& trajectory, const TrajectoryCheck& check);
/// The same of the walks of a run's methods, in one object.
std::string CheckJson(const std::string& run,
                      const std::vector<std::pair<std::string, TrajectoryCheck>>& methods);

}  // namespace halfstep::checker
