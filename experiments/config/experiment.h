#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/config/experiment_config.h"
#include "planner/scene/scene.h"
#include "smoothing/margins/margin_evaluator.h"
#include "wpg/geometry/footprint.h"
#include "wpg/motion/half_step_sequence.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// An experiment ready to run: everything that its config names, loaded and checked.
struct Experiment {
  ExperimentConfig config;
  RobotModel robot;
  Scene scene;
  HalfStepSequence sequence;
};

/// The files that a config names; no scene: an empty floor. They need not exist.
std::filesystem::path RobotPath(const ExperimentConfig& config);
std::optional<std::filesystem::path> ScenePath(const ExperimentConfig& config);

/// The same config with its paths relative to another folder, where it can be run from as well. An
/// output directory becomes that folder itself.
ExperimentConfig MovedTo(const std::filesystem::path& folder, const ExperimentConfig& config);

/// Where a config's walk takes place.
struct Place {
  RobotModel robot;
  Scene scene;
};
/// Loads the robot and the scene. Throws InputError.
Place LoadPlace(const ExperimentConfig& config);
/// The soles at the start, by Index(Side).
std::array<Footprint, 2> StartOf(const ExperimentConfig& config, const RobotModel& robot);

/// Makes the sequence, empty without footsteps, in a place that was loaded before.
Experiment Prepare(const ExperimentConfig& config, Place place);
/// The same in LoadPlace(config). Throws InputError.
Experiment Prepare(const ExperimentConfig& config);

/// The first footprint of the plan that touches a no-step polygon, as a sentence; none: all are
/// fine.
std::optional<std::string> FootprintOnNoStep(const Experiment& experiment);

/// Folder with the shipped robots (`NAME.yaml`) and with the shipped scenes: the source tree's, or
/// what the environment variable HALFSTEP_DATA says (it holds wpg/robots and experiments/scenes).
std::filesystem::path RobotsFolder();
std::filesystem::path ScenesFolder();
/// Paths of a folder's *.yaml, sorted; none when it cannot be read.
std::vector<std::filesystem::path> YamlFiles(const std::filesystem::path& folder);

}  // namespace halfstep
