#include "experiments/config/experiment_config.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include "experiments/config/data_folder.h"
#include "experiments/config/experiment.h"
#include "experiments/config/folder_name.h"
#include "experiments/config/footsteps_key.h"
#include "experiments/config/grouped_keys.h"
#include "experiments/config/scaled_defaults.h"
#include "smoothing/margins/family_traits.h"
#include "smoothing/walk/homotopy_parameters.h"
#include "wpg/elementary.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {
namespace {

void DeclareSole(Fields& fields, Pose2* X_WF, LevelChoice* on) {
  const NumberSpec position{.meaning = "of the sole's centre in the world",
                            .unit = "m",
                            .min = -1000,
                            .max = 1000,
                            .required = true};
  fields.Number("x_m", &X_WF->x, position);
  fields.Number("y_m", &X_WF->y, position);
  fields.Number(
      "yaw_deg", &X_WF->yaw,
      {.meaning = "not wrapped: 350 is not −10", .unit = "deg", .min = -3600, .max = 3600});
  fields.Text(
      "level", &on->name,
      {.meaning = "where levels lie above each other: the surface on which the sole stands, "
                  "or `floor`",
       .otherwise = "the highest",
       .left_out_empty = true});
  fields.OptionalNumber("z_m", &on->z,
                        {.meaning = "the same by the level's height",
                         .unit = "m",
                         .min = -1000,
                         .max = 1000,
                         .none_left_out = true});
  if (on->z && !on->name.empty()) fields.Complain("z_m", "beside `level` (valid: one of them)");
}

void DeclareFootstep(Fields& fields, FootstepConfig* step) {
  fields.Text("foot", &step->foot,
              {.meaning = "the foot that steps", .required = true, .choices = {"left", "right"}});
  DeclareSole(fields, &step->X_WF, &step->on);
  fields.OptionalNumber(
      "via_height_m", &step->via_height,
      {.meaning = "instead of half_step.via_height_m", .unit = "m", .min = 0.01, .max = 1});
  fields.OptionalNumber(
      "duration_s", &step->duration,
      {.meaning = "instead of half_step.duration_s", .unit = "s", .min = 0.6, .max = 6});
  fields.OptionalNumber("rest_s", &step->rest,
                        {.meaning = "how long the robot rests on both feet before the step; not of "
                                    "the first one, with which the walk begins",
                         .unit = "s",
                         .min = 0,
                         .max = kLongestRest,
                         .none_left_out = true});
  fields.OptionalNumber("rest_on_one_foot_s", &step->rest_on_one_foot,
                        {.meaning = "how long it rests on one foot before the other lands",
                         .unit = "s",
                         .min = 0,
                         .max = kLongestRest,
                         .none_left_out = true});
  fields.OptionalNumber("crouch_m", &step->crouch,
                        {.meaning = "instead of half_step.crouch_m: the waist comes to that height "
                                    "while the foot rises",
                         .unit = "m",
                         .min = 0,
                         .max = 0.5,
                         .none_left_out = true});
}

// The yaw nearest to `beside` that is the same place of a sole as `yaw` [rad].
double NearestTurn(double yaw, double beside) {
  return yaw - 2.0 * std::numbers::pi * std::round((yaw - beside) / (2.0 * std::numbers::pi));
}

// What there is to say against a sole whose yaw is more than half a turn from that of the other
// foot, since it has the same place with less; "" if nothing.
std::string YawJump(double yaw, double beside, const char* other) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  constexpr double kHalfTurn = std::numbers::pi * (1.0 + 1e-9);
  if (!(std::abs(yaw - beside) > kHalfTurn)) return "";
  return Formatted(
      "%.6g is %.6g° from the yaw of the %s foot beside it: yaws are not wrapped (did you mean "
      "%.6g?)",
      kDegrees * yaw, kDegrees * std::abs(yaw - beside), other,
      kDegrees * NearestTurn(yaw, beside));
}

// Declares footsteps, and complains about their yaws.
class YawJumps {
 public:
  explicit YawJumps(const ExperimentConfig& config)
      : yaws_{config.start_left.yaw, config.start_right.yaw} {}

  void Declare(Fields& fields, FootstepConfig* step) {
    DeclareFootstep(fields, step);
    const size_t side = step->foot == "left" ? 0 : 1;
    const double beside = yaws_[1 - side];
    const std::string jump = YawJump(step->X_WF.yaw, beside, side == 0 ? "right" : "left");
    if (!jump.empty()) fields.Complain("yaw_deg", jump);
    yaws_[side] = NearestTurn(step->X_WF.yaw, beside);  // so that one turn too many is told once
  }

 private:
  std::array<double, 2> yaws_;  // left and right, where they stand
};

// Complains about a goal that is out of the planner's workspace: the last foot lands beside one
// that carries, which stays inside.
void ComplainOutsideWorkspace(Fields& fields, const ExperimentConfig& c) {
  const std::vector<double>& w = c.planner.workspace;
  if (!c.has_goal || w.size() != 4) return;
  const StepGrid& grid = c.step_set;
  const double step = Hypot(std::max(std::abs(grid.x_min), std::abs(grid.x_max)),
                            std::max(std::abs(grid.y_min), std::abs(grid.y_max)));
  const GoalRegion goal = c.goal.Region();
  const double size = goal.box ? 0.5 * goal.box->norm() : goal.radius;
  const Eigen::AlignedBox2d workspace(Eigen::Vector2d(w[0], w[1]), Eigen::Vector2d(w[2], w[3]));
  const double outside = workspace.exteriorDistance(goal.X_WG.position());
  if (outside <= size + step) return;
  fields.Complain("goal", Formatted("lies %.3g m outside of planner.workspace_m, and a step of the "
                                    "step_set is %.3g m long at most (valid: within its reach)",
                                    outside, step));
}

// What there is to say against smoothing.fixed; the half-steps of a plan are not known before it.
std::string ComplaintAboutFixed(const ExperimentConfig& config) {
  if (config.smoothing.fixed.empty()) return "";
  if (config.has_goal) return "the half-steps are not planned yet (valid: with `footsteps`)";
  HalfStepSequence sequence;
  for (const FootstepConfig& footstep : config.footsteps) {
    HalfStep half_step;
    half_step.duration = footstep.duration.value_or(config.half_step.duration);
    half_step.shape = ShapeOf(config.half_step);
    sequence.half_steps.push_back({half_step, {}, footstep.rest.value_or(0.0)});
    sequence.half_steps.push_back({half_step, {}, footstep.rest_on_one_foot.value_or(0.0)});
  }
  return ComplaintAbout(sequence, FixedParameters(config.smoothing));
}

void ScaleDefaultsForRobot(const std::string& directory, ExperimentConfig* c) {
  c->directory = directory;
  try {
    ScaleDefaults(MeasureRobot(RobotPath(*c).string()), c);
  } catch (const InputError&) {
  }
}

void DeclareStart(Fields& fields, ExperimentConfig* c) {
  fields.OptionalGroup(
      "start", &c->has_start,
      {.meaning = "where the soles stand at the start",
       .otherwise =
           "feet side by side about the origin, `standing_width` apart (HRP-2: y = ±0.105 m)"},
      [&](Fields& f) {
        f.Group("left", {.meaning = "the left sole", .required = true},
                [&](Fields& g) { DeclareSole(g, &c->start_left, &c->start_left_on); });
        f.Group("right", {.meaning = "the right sole", .required = true},
                [&](Fields& g) { DeclareSole(g, &c->start_right, &c->start_right_on); });
        const std::string jump = YawJump(c->start_right.yaw, c->start_left.yaw, "left");
        if (!jump.empty()) f.Complain("right", "yaw_deg: " + jump);
      });
}

// Where the walk leads: a goal, or footsteps.
void DeclareWay(Fields& fields, ExperimentConfig* c) {
  fields.OptionalGroup(
      "goal", &c->has_goal,
      {.meaning =
           "where the walk shall end; planned in place of `footsteps`, one of them is required"},
      [&](Fields& f) { DeclareGoal(f, &c->goal); });
  YawJumps jumps(*c);
  fields.List("footsteps",
              {.meaning = "in the order of stepping, at least one unless there is a `goal`",
               .max_items = 10000},
              &c->footsteps, [&](Fields& f, FootstepConfig* step) {
                jumps.Declare(f, step);
                if (step == c->footsteps.data() && step->rest.value_or(0.0) > 0.0) {
                  f.Complain("rest_s",
                             "of the first footstep, with which the walk begins (valid: "
                             "rest_on_one_foot_s, or footsteps from the second on)");
                }
              });
  const bool in_file = DeclareFootstepsFile(fields, c);
  if (!in_file && c->footsteps.empty() && !c->has_goal) {
    fields.Complain("footsteps", "there are none (valid: at least one, or a `goal`)");
  }
  if (!c->footsteps.empty() && c->has_goal) {
    fields.Complain("goal", "there are footsteps as well (valid: either of them)");
  }
}

void DeclareOutput(Fields& fields, ExperimentConfig* c) {
  fields.Text("directory", &c->output_directory,
              {.meaning = "the run folder, relative to the config",
               .otherwise = "`runs/NAME` in the working directory"});
  fields.OptionalNumber("period_s", &c->output_period,
                        {.meaning = "between rows of trajectory.csv; none: 0.005, and 0.001 of a "
                                    "walk whose ZMP shifts in less than 0.025 s",
                         .unit = "s",
                         .min = 1e-4,
                         .max = 1});
}

}  // namespace

void DeclareFields(Fields& fields, ExperimentConfig* c) {
  fields.Text("name", &c->name,
              {.meaning = "of the run and its folder: no `/`, at most 100 bytes, not begun with "
                          "`.`, `-`, `=`, `+`, `@`",
               .otherwise = "the file's name without extension"});
  CheckName(fields, c->name);
  fields.Text(
      "robot", &c->robot,
      {.meaning = "a shipped robot's name (`halfstep list robots`), or the path of a robot file",
       .required = true});
  // Whatever is wrong with the robot is told when it is loaded.
  if (!c->robot.empty() && !fields.Keys().empty()) ScaleDefaultsForRobot(fields.directory(), c);
  fields.Text("scene", &c->scene,
              {.meaning = "path of a scene file, a shipped scene's name, or `none`: an empty floor",
               .required = true});
  DeclareStart(fields, c);
  DeclareWay(fields, c);
  fields.Group("planner", {.meaning = "how the way to the goal is found"},
               [&](Fields& f) { DeclarePlanner(f, &c->planner); });
  fields.Renamed("half_steps", "step_set");
  fields.Group("step_set", {.meaning = "places that the planner chooses from"},
               [&](Fields& f) { DeclareStepSet(f, &c->step_set); });
  ComplainOutsideWorkspace(fields, *c);
  fields.Group("swept_volumes", {.meaning = "that half-steps of the set sweep"},
               [&](Fields& f) { DeclareSweptVolumes(f, &c->swept_volumes); });
  fields.Group("half_step", {.meaning = "the isolated half-step"},
               [&](Fields& f) { DeclareHalfStep(f, &c->half_step); });
  fields.Group("smoothing", {.meaning = "the homotopy"}, [&](Fields& f) {
    DeclareSmoothing(f, &c->smoothing);
    const std::string complaint = ComplaintAboutFixed(*c);
    if (!complaint.empty()) f.Complain("fixed", complaint);
    if (c->has_goal && c->smoothing.repair_plan) {
      f.Complain("repair_plan",
                 "plans to a goal are of steps that were proved (valid: `false` with a `goal`)");
    }
  });
  fields.OptionalGroup("replay", &c->has_replay,
                       {.meaning = "simulated robots that play each certified walk",
                        .otherwise = "nothing is simulated"},
                       [&](Fields& f) { DeclareReplay(f, &c->replay); });
  fields.Group("output", {.meaning = "what is written"}, [&](Fields& f) { DeclareOutput(f, c); });
  fields.Integer("seed", &c->seed,
                 {.meaning = "of the planner's random numbers", .min = 0, .max = 2147483647});
}

void DeclareFilesThere(Fields& fields, const ExperimentConfig& config) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(RobotPath(config), ignored)) {
    fields.Complain("robot", UnknownRobot(config.robot));
  }
  const std::optional<std::filesystem::path> scene = ScenePath(config);
  if (scene && !std::filesystem::is_regular_file(*scene, ignored)) {
    fields.Complain("scene",
                    "no such file: " + Quote(scene->string()) + " (" + NearestFile(*scene) +
                        "valid: `none`, a path relative to this file, or a shipped scene's name)");
  }
}

std::vector<KeyDescription> ConfigKeys(Toolbox tools) {
  ExperimentConfig config;
  SetKnown(std::move(tools.methods), &config.smoothing);
  config.planner.known = std::move(tools.planners);
  std::vector<KeyDescription> keys =
      DescribeKeys([&config](Fields& fields) { DeclareFields(fields, &config); });
  DescribeScaling(&keys);
  return keys;
}

ExperimentConfig LoadConfig(const std::string& path, const std::vector<YamlOverride>& overrides,
                            Toolbox tools) {
  const std::string file = FileOrShipped(path, "configs").string();
  return ParseConfig(file, ReadYamlFile(file), overrides, std::move(tools));
}

ExperimentConfig ParseConfig(const std::string& path, const std::string& text,
                             const std::vector<YamlOverride>& overrides, Toolbox tools) {
  const std::filesystem::path file(path);
  ExperimentConfig config;
  SetKnown(std::move(tools.methods), &config.smoothing);
  config.planner.known = std::move(tools.planners);
  config.name = file.stem().string();
  ReadYamlText(text, path, file.parent_path().string(), overrides, [&](Fields& fields) {
    DeclareFields(fields, &config);
    fields.Misplaced("live", "this is the config of an episode (valid: `halfstep live` takes it)");
    static const std::vector<KeyDescription> keys = ConfigKeys({});
    RefuseKeysOfGroups(fields, keys);
    config.directory = fields.directory();
    DeclareFilesThere(fields, config);
  });
  return config;
}

}  // namespace halfstep
