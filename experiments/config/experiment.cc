#include "experiments/config/experiment.h"

#include <cmath>
#include <limits>

#include "experiments/config/data_folder.h"
#include "planner/ground/flat_floor.h"
#include "planner/ground/level_borders.h"
#include "planner/ground/level_ground.h"
#include "planner/scene/doubtful_obstacles.h"
#include "planner/scene/no_step_areas.h"
#include "smoothing/margins/demandable.h"
#include "smoothing/margins/family_traits.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/motion/lipm.h"
#include "wpg/nth.h"
#include "wpg/robot/acceleration_limits.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

// A bare word is a shipped robot, anything else a path relative to the config.
bool IsShipped(const fs::path& robot) { return !robot.has_parent_path() && !robot.has_extension(); }

// Demands nothing of the families for which the robot's files do not say enough; what only some
// robots have stays as the config says. Adds what the tube asks of this robot.
void FitDemands(Experiment* experiment) {
  MarginLimits& limits = experiment->config.smoothing.limits;
  // What a tube takes of the ZMP is derived for one level.
  if (limits.tube != Tube{}) RequireFlatFloor(*experiment->scene.ground, "smoothing.tube");
  limits.raised = RaisedBy(limits.tube, experiment->robot);
  for (const MarginFamily family : AllMarginFamilies()) {
    if (Traits(family).may_be_absent) continue;
    if (WhyNotDemandable(family, experiment->robot).empty()) continue;
    limits.demanded_of(family) = kNotDemanded;
  }
}

// The soles at the start, by Index(Side), seen from above.
std::array<Pose2, 2> StartFromAbove(const ExperimentConfig& config, const RobotModel& robot) {
  if (config.has_start) return {config.start_left, config.start_right};
  const double y = 0.5 * robot.standing_width;
  return {Pose2{0.0, y, 0.0}, Pose2{0.0, -y, 0.0}};
}

// What keeps a sole from standing, as the rest of a sentence; "" where nobody knows.
std::string WhyNotBorne(const Ground& ground, const Eigen::Matrix2Xd& outline, const Pose2& X_WF,
                        const std::optional<GroundLevel>& on) {
  const LevelBorders borders(ground);
  if (borders.empty()) return "";
  LevelBorders::Nearest best{.distance = -std::numeric_limits<double>::infinity()};
  for (const GroundLevel& level : ground.Levels()) {
    if (on && level != *on) continue;
    const LevelBorders::Nearest one = borders.NearestTo(outline, X_WF, level.number);
    if (one.distance > best.distance) best = one;
  }
  // What is farther off its level than it is long does not reach over a border.
  const double length = 2.0 * outline.colwise().norm().maxCoeff();
  if (best.distance < -length) return ": there is nothing below it";
  if (best.distance > 0.0 || best.solid < 0) return "";
  return Formatted(": it reaches %.3g mm over the edge of %s", -1e3 * best.distance,
                   Nth(ground.Solids(), best.solid).name.c_str());
}

// Where the walk begins, steps and ends, seen from above.
Eigen::AlignedBox2d WalkBounds(const ExperimentConfig& config, const RobotModel& robot) {
  Eigen::AlignedBox2d bounds;
  const auto extend = [&bounds](const Pose2& X) { bounds.extend(Eigen::Vector2d(X.x, X.y)); };
  for (const Pose2& sole : StartFromAbove(config, robot)) extend(sole);
  for (const FootstepConfig& step : config.footsteps) extend(step.X_WF);
  if (config.has_goal) extend(config.goal.X_WG);
  return bounds;
}

}  // namespace

fs::path RobotPath(const ExperimentConfig& config) {
  const fs::path path = IsShipped(config.robot) ? RobotsFolder() / (config.robot + ".yaml")
                                                : fs::path(config.directory) / config.robot;
  return path.lexically_normal();
}

std::optional<fs::path> ScenePath(const ExperimentConfig& config) {
  if (config.scene == "none") return std::nullopt;
  const fs::path path = (fs::path(config.directory) / config.scene).lexically_normal();
  std::error_code ignored;
  if (fs::exists(path, ignored)) return path;
  const fs::path shipped = ShippedOr(config.scene, "scenes");
  return shipped == config.scene ? path : shipped;
}

GivenWalkFiles GivenPaths(const ExperimentConfig& config) {
  const auto found = [&config](const std::string& path) {
    if (path.empty()) return path;
    return (fs::path(config.directory) / path).lexically_normal().string();
  };
  return {found(config.smoothing.given.overlaps), found(config.smoothing.given.half_steps)};
}

ExperimentConfig MovedTo(const fs::path& folder, const ExperimentConfig& config) {
  ExperimentConfig moved = config;
  moved.directory = folder.string();
  if (!IsShipped(config.robot)) moved.robot = fs::proximate(RobotPath(config), folder).string();
  if (const auto scene = ScenePath(config)) moved.scene = fs::proximate(*scene, folder).string();
  moved.smoothing.given = GivenPaths(config);
  for (std::string* path : {&moved.smoothing.given.overlaps, &moved.smoothing.given.half_steps}) {
    if (!path->empty()) *path = fs::proximate(*path, folder).string();
  }
  if (!config.output_directory.empty()) moved.output_directory = ".";
  if (const std::string& cache = config.swept_volumes.cache; !cache.empty()) {
    const fs::path path = (fs::path(config.directory) / cache).lexically_normal();
    moved.swept_volumes.cache = fs::proximate(path, folder).string();
  }
  return moved;
}

Place LoadPlace(const ExperimentConfig& config) {
  const bool is_special = IsShipped(config.robot) || config.robot.ends_with(".urdf");
  if (is_special && !fs::exists(RobotPath(config))) {
    throw InputError({"robot: " + UnknownRobot(config.robot)});
  }
  Place place;
  place.robot = LoadRobot(RobotPath(config).string());
  if (const auto& limit = config.smoothing.assumed_acceleration) {
    AssumeAccelerationLimits(*limit, &place.robot);
  }
  if (const auto scene = ScenePath(config)) {
    place.scene = LoadScene(scene->string());
    // A robot is about twice as high as its CoM.
    for (std::string& told : DoubtfulObstacles(place.scene, 2 * place.robot.com_height,
                                               WalkBounds(config, place.robot))) {
      place.scene.warnings.push_back(std::move(told));
    }
  } else {
    place.scene.name = "none";
  }
  return place;
}

std::optional<GroundLevel> ChosenLevel(const Ground& ground, const std::string& who,
                                       const LevelChoice& on) {
  if (!on.name.empty()) {
    const std::optional<GroundLevel> level = LevelNamed(ground, on.name);
    if (level) return level;
    std::vector<std::string> names;
    for (const GroundSolid& solid : ground.Solids()) {
      if (solid.bears) names.push_back(solid.name);
    }
    if (LevelNamed(ground, "floor")) names.push_back("floor");
    if (names.size() > 20) names.resize(20);
    throw InputError({who + ".level: the scene has no surface of the name " + Quote(on.name) +
                      Suggestion(on.name, names)});
  }
  if (!on.z) return std::nullopt;
  std::string heights;
  for (const GroundLevel& level : ground.Levels()) {
    if (std::abs(level.height - *on.z) < 0.5e-9) return level;
    heights += (heights.empty() ? "" : ", ") + ShortestText(level.height);
  }
  throw InputError({who + ".z_m: no level of the scene is at z = " + ShortestText(*on.z) +
                    " m (valid: " + heights + ")"});
}

GoalRegion GoalOn(const GoalConfig& goal, const Ground& ground) {
  GoalRegion region = goal.Region();
  if (const auto level = ChosenLevel(ground, "goal", {.name = goal.level})) {
    region.height = level->height;
  }
  return region;
}

Foothold OnGround(const Ground& ground, const RobotModel& robot, const Pose2& X_WF,
                  const std::string& who, const LevelChoice& on) {
  const std::optional<GroundLevel> level = ChosenLevel(ground, who, on);
  const std::optional<Foothold> stands =
      level ? ground.Standing(robot.sole_outline, X_WF, level->height)
            : ground.Standing(robot.sole_outline, X_WF);
  if (stands && (!level || stands->height == level->height)) return *stands;
  throw InputError(
      {who +
       Formatted(": the ground does not bear a sole at x = %.6g m, y = %.6g m", X_WF.x, X_WF.y) +
       WhyNotBorne(ground, robot.sole_outline, X_WF, level) + " (valid: all of it on one level)"});
}

std::array<Foothold, 2> StartOf(const ExperimentConfig& config, const RobotModel& robot,
                                const Ground& ground) {
  const auto [left, right] = StartFromAbove(config, robot);
  return {OnGround(ground, robot, left, "start.left", config.start_left_on),
          OnGround(ground, robot, right, "start.right", config.start_right_on)};
}

std::vector<Footstep> FootstepsOf(const ExperimentConfig& config, const RobotModel& robot,
                                  const Ground& ground) {
  std::vector<Footstep> footsteps;
  for (const FootstepConfig& step : config.footsteps) {
    const std::string who = "footsteps[" + std::to_string(footsteps.size()) + "]";
    footsteps.push_back({.side = step.foot == "left" ? Side::kLeft : Side::kRight,
                         .X_WF = OnGround(ground, robot, step.X_WF, who, step.on),
                         .via_height = step.via_height.value_or(config.half_step.via_height),
                         .duration = step.duration.value_or(config.half_step.duration),
                         .rest = step.rest.value_or(0.0),
                         .rest_on_one_foot = step.rest_on_one_foot.value_or(0.0),
                         .crouch = step.crouch});
  }
  return footsteps;
}

HalfStep PrototypeOf(const ExperimentConfig& config) {
  HalfStep prototype;
  prototype.duration = config.half_step.duration;
  prototype.via_height = config.half_step.via_height;
  prototype.via_lateral = config.half_step.via_lateral;
  prototype.shape = ShapeOf(config.half_step);
  return prototype;
}

Experiment Prepare(const ExperimentConfig& config) { return Prepare(config, LoadPlace(config)); }

std::shared_ptr<const MotionModel> MotionModelOf(const RobotModel& robot,
                                                 const HalfStepShape& shape) {
  return std::make_shared<Lipm>(robot.com_height - shape.crouch);
}

HalfStepSequence SequenceOf(const ExperimentConfig& config, const RobotModel& robot,
                            const Ground& ground) {
  const std::array<Foothold, 2> start = StartOf(config, robot, ground);
  const HalfStepShape shape = ShapeOf(config.half_step);
  if (config.footsteps.empty()) return {start, {}, MotionModelOf(robot, shape)};
  HalfStepSequence sequence =
      MakeSequence(start, FootstepsOf(config, robot, ground), config.half_step.via_lateral, shape,
                   MotionModelOf(robot, shape));
  for (int step = 0; step < sequence.num_steps(); ++step) {
    const double scale = LeastHeightScale(sequence, step);
    if (scale <= 1.0) continue;
    const double via = Nth(sequence.half_steps, 2 * step).half_step.via_height;
    throw InputError({"footsteps[" + std::to_string(step) + "].via_height_m: " + ShortestText(via) +
                      " is lower than a footstep of that step (valid: from " +
                      ShortestText(scale * via) + " above the support sole)"});
  }
  return sequence;
}

ExperimentConfig Changed(ExperimentConfig config, const std::vector<PlanChange>& changes) {
  const auto set = [](const std::optional<double>& value, auto* changed) {
    if (value) *changed = *value;
  };
  for (const PlanChange& change : changes) {
    if (!change.step) {
      set(change.duration, &config.half_step.duration);
      set(change.via_height, &config.half_step.via_height);
      set(change.crouch, &config.half_step.crouch);
      continue;
    }
    FootstepConfig& footstep = Nth(config.footsteps, *change.step);
    set(change.duration, &footstep.duration);
    set(change.via_height, &footstep.via_height);
    if (!change.landing) continue;
    footstep.X_WF.x = change.landing->x();
    footstep.X_WF.y = change.landing->y();
  }
  return config;
}

Experiment Prepare(const ExperimentConfig& config, Place place) {
  Experiment experiment{.config = config,
                        .robot = std::move(place.robot),
                        .scene = std::move(place.scene),
                        .sequence = {}};
  FitDemands(&experiment);
  experiment.sequence = SequenceOf(config, experiment.robot, *experiment.scene.ground);
  return experiment;
}

std::optional<std::string> FootholdOnNoStep(const Experiment& experiment) {
  const NoStepAreas areas(experiment.scene, experiment.robot.sole_outline);
  const MarginLimits limits = Demandable(experiment.config.smoothing.limits, experiment.robot);
  const double apart = limits.demanded_of(MarginFamily::kNoStep);
  const auto touches = [&](const Pose2& X_WF) { return !areas.Clears(X_WF, apart); };
  const std::array<Pose2, 2> start = StartFromAbove(experiment.config, experiment.robot);
  for (Side side : {Side::kLeft, Side::kRight}) {
    if (touches(Nth(start, Index(side)))) {
      return "the " + std::string(Name(side)) + " foot starts on a no-step area";
    }
  }
  for (size_t i = 0; i < experiment.config.footsteps.size(); ++i) {
    if (touches(experiment.config.footsteps[i].X_WF)) {
      return "footstep " + std::to_string(i + 1) + " is on a no-step area";
    }
  }
  return std::nullopt;
}

}  // namespace halfstep
