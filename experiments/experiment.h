#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "experiments/experiment_config.h"
#include "planner/scene.h"
#include "smoothing/margin_evaluator.h"
#include "wpg/half_step_sequence.h"
#include "wpg/robot_model.h"

namespace halfstep {

/// An experiment ready to run: everything that its config names, loaded and checked.
struct Experiment {
  ExperimentConfig config;
  RobotModel robot;
  Scene scene;
  HalfStepSequence sequence;
};

/// Loads the robot and the scene and makes the sequence. Throws InputError.
Experiment Prepare(const ExperimentConfig& config);

/// The first footprint of the plan that touches a no-step polygon, as a sentence; none: all are
/// fine.
std::optional<std::string> FootprintOnNoStep(const Experiment& experiment);

/// Folder with the shipped robots (`NAME.yaml`) and with the shipped scenes: the source tree's, or
/// what the environment variable HALFSTEP_DATA says (it holds wpg/robots and experiments/scenes).
std::filesystem::path RobotsFolder();
std::filesystem::path ScenesFolder();

}  // namespace halfstep
