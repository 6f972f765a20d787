#pragma once

#include <vector>

#include "wpg/files/key_description.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {

struct ExperimentConfig;

/// Defaults of a config that go by the robot's size: HRP-2's number, times a factor of the robot's
/// measures that is 1 for HRP-2. Lengths go by the leg's length ℓ, so that the legs' angles stay
/// about what they are; times by √ℓ, as a pendulum's do, but are long enough for the slowest joint;
/// the via point's distance from the support sole goes by the width of stance. Results are rounded
/// to three digits. README of experiments, "Defaults that go by the robot".
void ScaleDefaults(const RobotMeasures& robot, ExperimentConfig* config);

/// Writes the formulas into the descriptions of a config's keys, in place of HRP-2's numbers.
void DescribeScaling(std::vector<KeyDescription>* keys);
/// The same with the value for one robot.
void DescribeScaling(const RobotMeasures& robot, std::vector<KeyDescription>* keys);

}  // namespace halfstep
