#pragma once

#include <string>

#include "experiments/checker/check_trajectory.h"

namespace halfstep::checker {

/// What was found, for the screen: a line a kind, and one for each subject that is not proved.
std::string CheckScreen(const Trajectory& trajectory, const TrajectoryCheck& check);
/// The same as one JSON object, with every finding.
std::string CheckJson(const Trajectory& trajectory, const TrajectoryCheck& check);

}  // namespace halfstep::checker
