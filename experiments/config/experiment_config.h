#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/config/planning_config.h"
#include "smoothing/margins/margin.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/horizon.h"
#include "smoothing/methods/overlap_optimizer.h"
#include "smoothing/methods/pareto.h"
#include "smoothing/proof/certificate.h"
#include "wpg/files/fields.h"
#include "wpg/files/key_description.h"
#include "wpg/files/yaml_fields.h"
#include "wpg/geometry/footprint.h"
#include "wpg/geometry/side.h"

namespace halfstep {

/// One footstep of a config: a sole's place in the world, and what differs from `half_step`.
struct FootstepConfig {
  std::string foot = "left";         ///< "left" or "right"
  Footprint X_WF;                    ///< the sole's place in W
  std::optional<double> via_height;  ///< [m]
  std::optional<double> duration;    ///< [s]
};

/// The group `half_step`: what holds for every half-step whose footstep says nothing else.
struct HalfStepConfig {
  double duration = 2.0;                ///< T [s]
  double zmp_shift = 0.1;               ///< t2 − t1 at that T [s]; scales with the duration
  double via_height = 0.25;             ///< [m]
  double via_lateral = 0.24;            ///< [m]
  double horizontal_delay = 0.1;        ///< of T
  std::optional<double> zmp_bump_ramp;  ///< of the bump
  double foot_ramp = 0.5;               ///< of the foot's horizontal motion
  double lift_share = 1.0;              ///< of the foot's flight
  double support_offset = 0.0;          ///< [m]
  int compensation = 0;                 ///< iterations (Compensation)
};

/// Fractions of T, as half-steps have them.
HalfStepShape ShapeOf(const HalfStepConfig& config);

/// Options of the methods that are solvers.
struct OptimizerConfig {
  std::string program = "fastest";  ///< one of the names of ProgramKind
  OptimizerOptions options;         ///< also holds for the solvers of ParetoCurve
  ParetoOptions pareto;             ///< used where `program` is `pareto`
};

/// A parameter that methods leave alone, as a config names it: "overlap", 3 (from 1).
struct FixedConfig {
  std::string parameter = "overlap";  ///< the name of a parameter family
  int index = 1;                      ///< junction, step or half-step of the family, from 1
  std::optional<double> value;        ///< in the family's unit; none: as planned
};

/// Files that hold a walk of one's own, with columns of overlaps.csv and half_steps.csv; "": none.
struct GivenWalkFiles {
  std::string overlaps;    ///< one row a junction
  std::string half_steps;  ///< one row a half-step
};

/// The group `smoothing`: the methods, and what they have to keep.
struct SmoothingConfig {
  std::vector<std::string> methods = {"dichotomy"};  ///< in the order in which they run
  std::string acceptance = "certified";  ///< "certified" or "sampled": how a method accepts a walk
  double sampling = 0.005;               ///< period of acceptance `sampled` [s]
  std::string stop_branches = "none";    ///< one of the names of StopBranches
  bool repair_plan = false;              ///< RepairPlan() before the methods
  CertificationOptions certification;    ///< of proofs, whatever `acceptance` is
  DichotomyOptions dichotomy;            ///< of the dichotomy and of the methods that begin with it
  OptimizerConfig optimizer;             ///< of the methods that are solvers
  HorizonOptions horizon;                ///< window, step and passes
  std::vector<FixedConfig> fixed;        ///< parameters that no method moves
  bool has_given = false;                ///< whether `given` names files
  GivenWalkFiles given;                  ///< of the method `given`
  MarginLimits limits;                   ///< limits and demanded margins
};

/// An experiment as its YAML file says it (top keys: experiments/README.md). Paths are as written.
struct ExperimentConfig {
  std::string name;   ///< default: the file's stem
  std::string robot;  ///< a shipped robot's name or a path
  std::string scene;  ///< a path; "none": empty floor
  /// Whether `start` is given; else the feet stand beside each other at the origin.
  bool has_start = false;
  Footprint start_left, start_right;      ///< X_WF of the soles, when has_start
  bool has_goal = false;                  ///< else there are footsteps
  GoalConfig goal;                        ///< used when has_goal
  std::vector<FootstepConfig> footsteps;  ///< empty when has_goal
  PlannerConfig planner;                  ///< used when has_goal
  HalfStepGrid half_step_grid;            ///< the placements that planners choose from
  SweptVolumesConfig swept_volumes;       ///< of the planners that ask them
  HalfStepConfig half_step;               ///< of all half-steps
  SmoothingConfig smoothing;              ///< methods, limits and margins
  std::string output_directory;           ///< "": `runs/<name>` in the working directory
  double output_period = 0.005;           ///< of trajectory.csv [s]
  int seed = 1;                           ///< of planners' random numbers
  std::string directory;                  ///< folder of the file, to which relative paths refer
};

/// Declares every key of a config once: reading, writing back and explaining all use this.
void DeclareFields(Fields& fields, ExperimentConfig* config);

/// Complains, at the place that names it, about a file of the config that is not there. To be
/// called after DeclareFields(), when the config knows its folder.
void DeclareFilesThere(Fields& fields, const ExperimentConfig& config);

/// The parameters that a config fixes. Precondition: each names a family, which reading ensures.
std::vector<FixedParameter> FixedParameters(const SmoothingConfig& config);

/// The keys that DeclareFields declares, as data; defaults that go by the robot as formulas.
std::vector<KeyDescription> ConfigKeys();

/// Reads a config file strictly. Throws InputError with every complaint at once.
ExperimentConfig LoadConfig(const std::string& path, const std::vector<YamlOverride>& overrides);
/// The same for a config file's text.
ExperimentConfig ParseConfig(const std::string& path, const std::string& text,
                             const std::vector<YamlOverride>& overrides);

}  // namespace halfstep
