#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/config/experiment_config.h"
#include "planner/scene/scene.h"
#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/methods/plan_change.h"
#include "wpg/geometry/foothold.h"
#include "wpg/ground/ground.h"
#include "wpg/motion/half_step_sequence.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// An experiment ready to run: everything that its config names, loaded and checked.
struct Experiment {
  ExperimentConfig config;    ///< as resolved
  RobotModel robot;           ///< with the margins' defaults of its size
  Scene scene;                ///< empty when the config says `none`
  HalfStepSequence sequence;  ///< the footsteps' half-steps, planned and placed in W
};

/// Paths of the files that a config names, which need not exist. No scene: an empty floor.
std::filesystem::path RobotPath(const ExperimentConfig& config);
/// The same of the scene; none: an empty floor.
std::optional<std::filesystem::path> ScenePath(const ExperimentConfig& config);

/// The files of smoothing.given, as they are found from the working directory.
GivenWalkFiles GivenPaths(const ExperimentConfig& config);

/// The same config with its paths relative to another folder, so that it can be run from there. An
/// output directory becomes that folder itself.
ExperimentConfig MovedTo(const std::filesystem::path& folder, const ExperimentConfig& config);

/// The level that a file chooses of a ground; none where it does not. Throws InputError, which
/// begins with `who`, where there is none such.
std::optional<GroundLevel> ChosenLevel(const Ground& ground, const std::string& who,
                                       const LevelChoice& on);
/// The region of a config's goal, at the height of the level that it names. Throws InputError as
/// ChosenLevel.
GoalRegion GoalOn(const GoalConfig& goal, const Ground& ground);
/// Where a config's walk takes place.
struct Place {
  RobotModel robot;  ///< as in Experiment
  Scene scene;       ///< as in Experiment
};
/// Loads the robot and the scene. Throws InputError.
Place LoadPlace(const ExperimentConfig& config);
/// The place of a sole at X_WF, seen from above, on the ground's level there: all that files say of
/// soles becomes footholds here. Throws InputError, which begins with `who`, where the ground does
/// not bear the sole, or not on the level that was chosen.
Foothold OnGround(const Ground& ground, const RobotModel& robot, const Pose2& X_WF,
                  const std::string& who, const LevelChoice& on = {});

/// The soles at the start, by Index(Side). Throws InputError as OnGround, as do the next ones.
std::array<Foothold, 2> StartOf(const ExperimentConfig& config, const RobotModel& robot,
                                const Ground& ground);
/// The config's footsteps; its own via heights and durations where they have none.
std::vector<Footstep> FootstepsOf(const ExperimentConfig& config, const RobotModel& robot,
                                  const Ground& ground);

/// The half-steps of a config without their place: duration, via point, shape.
HalfStep PrototypeOf(const ExperimentConfig& config);

/// What proposes how CoM and ZMP of a robot move in half-steps of this shape, whose crouch lowers
/// the CoM.
std::shared_ptr<const MotionModel> MotionModelOf(const RobotModel& robot,
                                                 const HalfStepShape& shape);

/// The half-steps of a config's footsteps; empty without footsteps.
HalfStepSequence SequenceOf(const ExperimentConfig& config, const RobotModel& robot,
                            const Ground& ground);
/// The config whose plan goes another way: with these durations, heights and landings, of single
/// footsteps or of `half_step`.
ExperimentConfig Changed(ExperimentConfig config, const std::vector<PlanChange>& changes);
/// Makes the experiment in a place that is loaded; without footsteps its sequence is empty.
Experiment Prepare(const ExperimentConfig& config, Place place);
/// The same, in the place that LoadPlace() loads. Throws InputError.
Experiment Prepare(const ExperimentConfig& config);

/// The first foothold of the plan that touches a no-step polygon, as a sentence; none when no
/// foothold does.
std::optional<std::string> FootholdOnNoStep(const Experiment& experiment);

}  // namespace halfstep
