#pragma once

#include <array>
#include <optional>

#include "experiments/config/experiment_config.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/level_tops.h"
#include "experiments/verify/walk_plan.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// What a config says of all half-steps, and the soles that it starts from.
HalfStep HalfStepOf(const HalfStepConfig& config);
/// By Index(Side), seen from above.
std::array<Pose2, 2> StartSoles(const ExperimentConfig& config, const RobotModel& robot);
/// The same at the heights that the ground has there, and PlanOf: none where it does not bear them,
/// which the findings tell.
std::optional<std::array<Foothold, 2>> StartOn(const ExperimentConfig& config,
                                               const RobotModel& robot, const LevelTops& ground,
                                               Findings* findings);
/// The plan of a config's footsteps, at the heights that the ground has there; none where it does
/// not bear a sole, which the findings tell.
std::optional<WalkPlan> PlanOf(const ExperimentConfig& config, const RobotModel& robot,
                               const LevelTops& ground, Findings* findings);

}  // namespace halfstep::verify
