#pragma once

#include <string>
#include <vector>

#include "experiments/config/half_step_config.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The length of a robot's leg over HRP-2's, by which lengths of tables for HRP-2 go.
double SizeOf(const RobotModel& robot);

/// Forms of half-steps by which robots get from level to level, the config's own first: of its
/// duration or longer ones, with via points 2 or 5 cm above `highest` ≥ 0, the largest difference
/// of height that is to be crossed [m], a crouch of 0 to 2 cm, a foot that moves on later or rises
/// sooner, and a waist that rises sooner or later. Lengths are for HRP-2 and go by `size` (SizeOf).
std::vector<HalfStepConfig> HalfStepTable(const HalfStepConfig& own, double highest, double size);

/// Forms of half-steps that lead over an obstacle whose `top` is higher than the floor [m]: of the
/// config's duration or longer ones, with via points 2 or 5 cm above it, a crouch of 0 to 8 cm, a
/// foot that moves on later or rises sooner. The config's own is not among them. Lengths as above.
std::vector<HalfStepConfig> TableOverObstacle(const HalfStepConfig& own, double top, double size);

/// "duration_s: 2.6, via_height_m: 0.17 …": what a form has that differs from another.
std::string Differences(const HalfStepConfig& form, const HalfStepConfig& from);

}  // namespace halfstep
