#pragma once

#include <vector>

#include "experiments/config/experiment.h"
#include "planner/search/step_set.h"
#include "smoothing/margins/margin_evaluator.h"

namespace halfstep {

/// The places of a grid for ground whose heights are looked up, level and seen from a left support:
/// those of yaw 0 four times as dense along x and twice along y, so that soles find the middle of
/// treads of any run.
std::vector<Foothold> PlacesOf(const StepGrid& grid);

/// Those of a config's grid that a planner tries. Left out is what misses a margin at one of a few
/// instants on a level floor. Nothing of it is proved: that is for CertificateQuery.
StepSet StepsByGround(const RobotModel& robot, const ExperimentConfig& config);

}  // namespace halfstep
