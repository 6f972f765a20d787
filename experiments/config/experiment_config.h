#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/config/half_step_config.h"
#include "experiments/config/planning_config.h"
#include "experiments/config/replay_config.h"
#include "experiments/config/smoothing_config.h"
#include "experiments/config/toolbox.h"
#include "wpg/files/fields.h"
#include "wpg/files/input_file.h"
#include "wpg/files/key_description.h"
#include "wpg/files/yaml_fields.h"
#include "wpg/geometry/pose2.h"
#include "wpg/geometry/side.h"

namespace halfstep {

/// Which level a sole stands on where several lie above each other; neither: the highest.
struct LevelChoice {
  std::string name = {};         ///< of a surface, or "floor"; "": not said
  std::optional<double> z = {};  ///< the level's height [m]
};

/// One footstep of a config: a sole's place in the world, and what differs from `half_step`.
/// Its height follows from the ground (StartOf, FootstepsOf).
struct FootstepConfig {
  std::string foot = "left";                    ///< "left" or "right"
  Pose2 X_WF;                                   ///< the sole's place in W, seen from above
  std::optional<double> via_height;             ///< [m]
  std::optional<double> duration;               ///< [s]
  LevelChoice on = {};                          ///< the level
  std::optional<double> rest = {};              ///< Footstep::rest [s]; none: 0
  std::optional<double> rest_on_one_foot = {};  ///< Footstep::rest_on_one_foot [s]; none: 0
  std::optional<double> crouch = {};            ///< Footstep::crouch [m]
};

/// An experiment as its YAML file says it (top keys: experiments/config.md). Paths are as written.
struct ExperimentConfig {
  std::string name;   ///< default: the file's stem
  std::string robot;  ///< a shipped robot's name or a path
  std::string scene;  ///< a path; "none": empty floor
  /// Whether `start` is given; else the feet stand beside each other at the origin.
  bool has_start = false;
  Pose2 start_left, start_right;              ///< X_WF of the soles, when has_start
  LevelChoice start_left_on, start_right_on;  ///< their levels
  bool has_goal = false;                      ///< else there are footsteps
  GoalConfig goal;                            ///< used when has_goal
  std::vector<FootstepConfig> footsteps;      ///< empty when has_goal
  std::optional<InputFile> footsteps_file;    ///< that these were read from, if it was one
  PlannerConfig planner;                      ///< used when has_goal
  StepGrid step_set;                          ///< the placements that planners choose from
  SweptVolumesConfig swept_volumes;           ///< of the planners that ask them
  HalfStepConfig half_step;                   ///< of all half-steps
  SmoothingConfig smoothing;                  ///< methods, limits and margins
  bool has_replay = false;                    ///< whether certified walks are played
  ReplayConfig replay;                        ///< used when has_replay
  std::string output_directory;               ///< "": `runs/<name>` in the working directory
  std::optional<double> output_period;        ///< of trajectory.csv [s]; none: as its ZMP shifts
  int seed = 1;                               ///< of planners' random numbers
  std::string directory;                      ///< folder of the file, to which relative paths refer
};

/// Between the rows of trajectory.csv [s] where the config does not say.
inline constexpr double kRowPeriod = 0.005;
/// The same of a walk with a half-step whose ZMP shifts in less than kCoarseRows times that [s].
inline constexpr double kFineRowPeriod = 0.001;
inline constexpr int kCoarseRows = 5;  ///< see kFineRowPeriod
/// Which of them a trajectory.csv was written with whose second row is at `second` [s]; what the
/// config says where it does.
inline double RowPeriodOf(const ExperimentConfig& config, double second) {
  const bool fine = second < 0.5 * (kRowPeriod + kFineRowPeriod);
  return config.output_period.value_or(fine ? kFineRowPeriod : kRowPeriod);
}

/// Declares every key of a config once: reading, writing back and explaining all use this.
void DeclareFields(Fields& fields, ExperimentConfig* config);

/// Complains, at the place that names it, about a file of the config that is not there. To be
/// called after DeclareFields(), when the config knows its folder.
void DeclareFilesThere(Fields& fields, const ExperimentConfig& config);

/// The keys that DeclareFields declares, as data; defaults that go by the robot as formulas.
std::vector<KeyDescription> ConfigKeys(Toolbox tools = {});

/// Reads a config file strictly; it may name what these tools hold, and give it options. Throws
/// InputError with every complaint at once.
ExperimentConfig LoadConfig(const std::string& path, const std::vector<YamlOverride>& overrides,
                            Toolbox tools = {});
/// The same for a config file's text.
ExperimentConfig ParseConfig(const std::string& path, const std::string& text,
                             const std::vector<YamlOverride>& overrides, Toolbox tools = {});

}  // namespace halfstep
