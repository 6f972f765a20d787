#pragma once

#include <array>

#include "experiments/config/experiment_config.h"
#include "experiments/verify/walk_plan.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// What a config says of all half-steps, and the soles that it starts from.
HalfStep HalfStepOf(const HalfStepConfig& config);
/// By Index(Side).
std::array<Foothold, 2> StartSoles(const ExperimentConfig& config, const RobotModel& robot);
/// The plan of a config's footsteps.
WalkPlan PlanOf(const ExperimentConfig& config, const RobotModel& robot);

}  // namespace halfstep::verify
