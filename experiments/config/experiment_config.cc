#include "experiments/config/experiment_config.h"

#include <algorithm>
#include <filesystem>

#include "experiments/config/data_folder.h"
#include "experiments/config/experiment.h"
#include "experiments/config/folder_name.h"
#include "experiments/config/scaled_defaults.h"
#include "smoothing/margins/family_traits.h"
#include "smoothing/methods/smoother_registry.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {
namespace {

void DeclarePose(Fields& fields, Pose2* pose) {
  const NumberSpec position{.meaning = "of the sole's centre in the world",
                            .unit = "m",
                            .min = -1000,
                            .max = 1000,
                            .required = true};
  fields.Number("x_m", &pose->x, position);
  fields.Number("y_m", &pose->y, position);
  fields.Number(
      "yaw_deg", &pose->yaw,
      {.meaning = "not wrapped: 350 is not −10", .unit = "deg", .min = -3600, .max = 3600});
}

void DeclareFootstep(Fields& fields, FootstepConfig* step) {
  fields.Text("foot", &step->foot,
              {.meaning = "the foot that steps", .required = true, .choices = {"left", "right"}});
  DeclarePose(fields, &step->X_WF);
  fields.OptionalNumber(
      "via_height_m", &step->via_height,
      {.meaning = "instead of half_step.via_height_m", .unit = "m", .min = 0.01, .max = 1});
  fields.OptionalNumber(
      "duration_s", &step->duration,
      {.meaning = "instead of half_step.duration_s", .unit = "s", .min = 0.6, .max = 6});
}

void DeclareHalfStep(Fields& fields, HalfStepConfig* c) {
  fields.Number("duration_s", &c->duration,
                {.meaning = "T of an isolated half-step", .unit = "s", .min = 0.6, .max = 6});
  fields.Number("zmp_shift_s", &c->zmp_shift,
                {.meaning = "t2 − t1, the ZMP's shift, at that T: 0.01 … 0.5 of `duration_s`; a "
                            "footstep's own `duration_s` scales it",
                 .unit = "s",
                 .min = 0.02,
                 .max = 2});
  if (c->zmp_shift < 0.01 * c->duration || c->zmp_shift > 0.5 * c->duration) {
    fields.Complain("zmp_shift_s", "does not fit duration_s (valid: 0.01 … 0.5 of it)");
  }
  fields.Number("via_height_m", &c->via_height,
                {.meaning = "height of the via point", .unit = "m", .min = 0.01, .max = 1});
  fields.Number("via_lateral_m", &c->via_lateral,
                {.meaning = "distance of the via point from the support sole's centre",
                 .unit = "m",
                 .min = 0.01,
                 .max = 1});
  fields.Number(
      "horizontal_delay", &c->horizontal_delay,
      {.meaning = "fraction of T between take-off (landing) and the foot's horizontal motion",
       .min = 0,
       .max = 0.2});
  fields.OptionalNumber(
      "zmp_bump_ramp", &c->zmp_bump_ramp,
      {.meaning =
           "fraction of the ZMP's bump in which it rises, and in which it falls; constant in "
           "between; `none`: a round bump",
       .min = 0.1,
       .max = 0.5});
  fields.Number(
      "foot_ramp", &c->foot_ramp,
      {.meaning = "fraction of the foot's horizontal motion in which its speed rises, and "
                  "in which it falls; constant in between",
       .min = 0.1,
       .max = 0.5});
  fields.Number(
      "lift_share", &c->lift_share,
      {.meaning = "fraction of the foot's flight in which it rises, or sinks, next to the "
                  "floor",
       .min = 0.2,
       .max = 1});
  fields.Number("support_offset_m", &c->support_offset,
                {.meaning = "where CoM and ZMP rest on one foot: from the support sole's centre, "
                            "along its y, towards the other foot",
                 .unit = "m",
                 .min = -1,
                 .max = 1});
  static const std::vector<std::string> kIterations = {"none", "one", "two"};
  std::string compensation = kIterations[static_cast<size_t>(c->compensation)];
  fields.Text("compensation", &compensation,
              {.meaning = "iterations that move the waist so that the whole robot's ZMP comes near "
                          "the planned one in each isolated half-step",
               .choices = kIterations});
  const auto chosen = std::find(kIterations.begin(), kIterations.end(), compensation);
  if (chosen != kIterations.end()) c->compensation = static_cast<int>(chosen - kIterations.begin());
}

void DeclareDichotomy(Fields& fields, DichotomyOptions* o) {
  fields.Number("tolerance_s", &o->tolerance,
                {.meaning = "bisection of an overlap ends below this (published: 0.05)",
                 .unit = "s",
                 .min = 1e-6,
                 .max = 1});
  std::string order =
      o->order == DichotomyOptions::Order::kLeftToRight ? "left_to_right" : "right_to_left";
  fields.Text("order", &order,
              {.meaning = "of the junctions", .choices = {"left_to_right", "right_to_left"}});
  o->order = order == "left_to_right" ? DichotomyOptions::Order::kLeftToRight
                                      : DichotomyOptions::Order::kRightToLeft;
  fields.Integer("passes", &o->passes, {.meaning = "over all junctions", .min = 1, .max = 100});
  fields.Number("up_down_cap", &o->up_down_cap,
                {.meaning = "largest overlap as a fraction of its natural bound (published: 0.8)",
                 .min = 0,
                 .max = 1});
  fields.Number("down_up_cap", &o->down_up_cap,
                {.meaning = "largest overlap as a fraction of its natural bound (published: 0.76)",
                 .min = 0,
                 .max = 1});
}

void DeclareWeights(Fields& fields, EffortWeights* w) {
  const auto weight = [&](const char* key, double* value, const char* meaning, const char* unit) {
    fields.Number(key, value, {.meaning = meaning, .unit = unit, .min = 0, .max = 1000});
  };
  weight("com_acceleration", &w->com_acceleration, "of ∫‖c̈‖² dt", "s⁴/m²");
  weight("com_jerk", &w->com_jerk, "of ∫‖c⃛‖² dt", "s⁶/m²");
  weight("foot_speed", &w->foot_speed, "of ∫‖v‖² dt of both soles", "s²/m²");
}

// A weight for each cost that the program itself registered.
void DeclareOwnCosts(Fields& fields, std::vector<WeightedWalkCost>* costs) {
  std::vector<WeightedWalkCost> weighed;
  for (const auto& cost : WalkCosts()) {
    WeightedWalkCost own{.cost = cost};
    for (const WeightedWalkCost& known : *costs) {
      if (known.cost->name() == cost->name()) own.weight = known.weight;
    }
    const std::string name = cost->name(), meaning = cost->meaning(), unit = cost->unit();
    fields.Number(name.c_str(), &own.weight,
                  {.meaning = meaning.c_str(), .unit = unit.c_str(), .min = 0, .max = 1e6});
    if (own.weight != 0.0) weighed.push_back(std::move(own));
  }
  *costs = std::move(weighed);
}

void DeclareOptimizer(Fields& fields, OptimizerConfig* c) {
  OptimizerOptions* o = &c->options;
  fields.Text("program", &c->program,
              {.meaning = "what is optimized: duration; duration and effort; the least slack for a "
                          "duration; that for a range of durations",
               .choices = {"fastest", "smooth", "safest", "pareto"}});
  for (ProgramKind kind : {ProgramKind::kFastest, ProgramKind::kSmooth, ProgramKind::kSafest}) {
    if (c->program == Name(kind)) o->program.kind = kind;
  }
  ParameterChoice* const choice = &o->program.parameters;
  for (const ParameterFamily family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    if (traits.chosen == nullptr) continue;
    fields.Boolean(traits.key.data(), &(choice->*traits.chosen),
                   {.meaning = traits.key_meaning.data()});
  }
  for (const ParameterFamily family : AllParameterFamilies()) {
    for (const ParameterBoundKey& bound : Traits(family).bounds) {
      fields.Number(bound.key.data(), &(choice->*bound.value),
                    {.meaning = bound.meaning.data(),
                     .unit = bound.unit.data(),
                     .min = bound.min,
                     .max = bound.max});
    }
  }
  fields.Number("duration_s", &o->duration_limit,
                {.meaning = "`safest`: of the walk at most; 0: the dichotomy's own",
                 .unit = "s",
                 .min = 0,
                 .max = 100000});
  fields.Integer(
      "pareto_points", &c->pareto.points,
      {.meaning = "`pareto`: durations, from the fastest to the longest", .min = 2, .max = 200});
  fields.Number(
      "pareto_longest", &c->pareto.most_duration,
      {.meaning = "`pareto`: longest duration, of the planned motion's", .min = 0.1, .max = 3});
  fields.Group("weights", {.meaning = "`smooth`: of the effort beside the duration"},
               [&](Fields& f) {
                 DeclareWeights(f, &o->program.weights);
                 DeclareOwnCosts(f, &o->program.own_costs);
               });
  fields.Integer(
      "instants", &o->instants,
      {.meaning = "per half-step at which the program looks; 0: 24 for `halfstep/sqp`, 32 for "
                  "others",
       .min = 0,
       .max = 1000});
  fields.Integer("rounds", &o->rounds,
                 {.meaning = "solves from each start, each looking closer", .min = 1, .max = 100});
  fields.Boolean("planned_start", &o->planned_start,
                 {.meaning = "solve also from the planned motion, not only from the dichotomy's "
                             "result"});
  fields.Integer("random_starts", &o->random_starts,
                 {.meaning = "further starts, drawn from `seed`", .min = 0, .max = 1000});
  fields.Integer(
      "max_iterations", &o->max_iterations,
      {.meaning =
           "that the solver may make in a round, NLopt's excepted, which count none; 0: 3 for "
           "`halfstep/sqp`, 30 for others",
       .min = 0,
       .max = 100000});
  fields.Number(
      "deadline_s", &o->deadline,
      {.meaning =
           "of all solves of a method together; of `dichotomy/uniform`, `coordinate`, `reference`",
       .unit = "s",
       .min = 0.001,
       .max = 86400});
}

void DeclareHorizon(Fields& fields, HorizonOptions* o) {
  const auto half_steps = [&](const char* key, int* count, const char* meaning) {
    fields.Integer(key, count, {.meaning = meaning, .min = 2, .max = 1000});
    if (*count % 2 == 0) return;
    fields.Complain(key,
                    std::to_string(*count) + " is odd (valid: whole steps, two half-steps each)");
  };
  half_steps("window", &o->window, "half-steps that are moved together");
  half_steps("step", &o->step, "half-steps by which the next window lies further on");
  if (o->step > o->window) {
    fields.Complain("step", std::to_string(o->step) +
                                " leaves half-steps between windows (valid: up to `window`, " +
                                std::to_string(o->window) + ")");
  }
  fields.Integer(
      "passes", &o->passes,
      {.meaning = "over the walk at most; they end when nothing is gained", .min = 1, .max = 1000});
}

void DeclareFixed(Fields& fields, FixedConfig* c) {
  std::vector<std::string> names;
  for (const ParameterFamily family : AllParameterFamilies()) {
    names.emplace_back(Traits(family).name);
  }
  fields.Text("parameter", &c->parameter,
              {.meaning = "which kind of them", .required = true, .choices = names});
  fields.Integer("index", &c->index,
                 {.meaning = "of its junction, step or half-step, from 1", .min = 1, .max = 20000});
  fields.OptionalNumber(
      "value", &c->value,
      {.meaning = "s (an overlap below 0 is a rest), of the planned height, or m; none: as planned",
       .min = -kLongestRest,
       .max = 6});
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
    sequence.half_steps.insert(sequence.half_steps.end(), 2, {half_step, {}});
  }
  return ComplaintAbout(sequence, FixedParameters(config.smoothing));
}

void DeclareGiven(Fields& fields, GivenWalkFiles* files) {
  fields.Text("overlaps", &files->overlaps,
              {.meaning = "path of a table like overlaps.csv, one row a junction",
               .otherwise = "as planned"});
  fields.Text("half_steps", &files->half_steps,
              {.meaning = "path of a table like half_steps.csv, one row a half-step",
               .otherwise = "as planned"});
  if (files->overlaps.empty() && files->half_steps.empty()) {
    fields.Complain("", "no table is named (valid: `overlaps`, `half_steps` or both)");
  }
}

void DeclareLimits(Fields& fields, MarginLimits* l) {
  fields.OptionalNumber("foot_speed_m_s", &l->foot_speed,
                        {.meaning = "of the swing sole's centre; none: no limit",
                         .unit = "m/s",
                         .min = 0.01,
                         .max = 20});
  fields.OptionalNumber(
      "foot_yaw_rate_rad_s", &l->foot_yaw_rate,
      {.meaning = "of the swing sole; none: no limit", .unit = "rad/s", .min = 0.01, .max = 50});
  fields.Number("joint_speed_scale", &l->joint_speed_scale,
                {.meaning = "fraction of the robot's joint speed limits", .min = 0.01, .max = 1});
}

void DeclareMargins(Fields& fields, MarginLimits* l) {
  for (const MarginFamily family : AllMarginFamilies()) {
    const FamilyTraits& traits = Traits(family);
    const NumberSpec spec{.meaning = traits.meaning.data(),
                          .unit = traits.unit == "1" ? "" : traits.unit.data(),
                          .min = 0,
                          .max = traits.most};
    double& demanded = l->demanded_of(family);
    if (!traits.may_be_none) {
      fields.Number(traits.key.data(), &demanded, spec);
      continue;
    }
    std::optional<double> or_none;
    if (demanded != kNotDemanded) or_none = demanded;
    fields.OptionalNumber(traits.key.data(), &or_none, spec);
    demanded = or_none.value_or(kNotDemanded);
  }
}

void DeclareSmoothing(Fields& fields, SmoothingConfig* c) {
  fields.Texts("methods", &c->methods,
               {.meaning = "to run and compare, each once; `raw` is always written",
                .choices = SmootherNames(),
                .listed_by = "halfstep list methods"});
  for (auto method = c->methods.begin(); method != c->methods.end(); ++method) {
    if (std::find(c->methods.begin(), method, *method) != method) {
      fields.Complain("methods", Quote(*method) + " is there twice (valid: each method once)");
      break;
    }
  }
  fields.Text(
      "acceptance", &c->acceptance,
      {.meaning = "what makes a candidate acceptable", .choices = {"certified", "sampled"}});
  fields.Number("sampling_s", &c->sampling,
                {.meaning = "period of the sampled checks (`sampled` only)",
                 .unit = "s",
                 .min = 1e-4,
                 .max = 0.1});
  fields.Number("resolution_s", &c->certification.resolution,
                {.meaning = "certification gives up on shorter intervals: undecided",
                 .unit = "s",
                 .min = 1e-7,
                 .max = 0.01});
  fields.Text("stop_branches", &c->stop_branches,
              {.meaning = "after which half-steps the walk can be stopped, every margin kept",
               .choices = {"none", "down", "all"}});
  fields.Boolean("repair_plan", &c->repair_plan,
                 {.meaning = "steps of a plan that is not feasible take longer, or go higher or "
                             "lower, where that makes them feasible"});
  fields.Group("dichotomy", {.meaning = "options of the method `dichotomy`"},
               [&](Fields& f) { DeclareDichotomy(f, &c->dichotomy); });
  fields.Group(
      "optimizer",
      {.meaning =
           "options of the methods that are solvers (smoothing/README.md, \"Overlap program\")"},
      [&](Fields& f) { DeclareOptimizer(f, &c->optimizer); });
  fields.Group("horizon",
               {.meaning = "windows of `halfstep/horizon`; its program, variables and deadline are "
                           "those of `optimizer`"},
               [&](Fields& f) { DeclareHorizon(f, &c->horizon); });
  fields.List("fixed", {.meaning = "parameters that no method may move"}, &c->fixed, DeclareFixed);
  fields.OptionalGroup("given", &c->has_given,
                       {.meaning = "the walk of the method `given`, from tables with the columns "
                                   "of a run; parameters without a column are as planned"},
                       [&](Fields& f) { DeclareGiven(f, &c->given); });
  const bool takes_given = std::ranges::find(c->methods, "given") != c->methods.end();
  if (takes_given && !c->has_given) {
    fields.Complain("methods", "'given' without a walk (valid: with `smoothing.given`)");
  }
  fields.Group("limits", {.meaning = "what the robot file does not limit"},
               [&](Fields& f) { DeclareLimits(f, &c->limits); });
  fields.Group("margins", {.meaning = "demanded margins: feasible means at least this far inside"},
               [&](Fields& f) { DeclareMargins(f, &c->limits); });
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
                [&](Fields& g) { DeclarePose(g, &c->start_left); });
        f.Group("right", {.meaning = "the right sole", .required = true},
                [&](Fields& g) { DeclarePose(g, &c->start_right); });
      });
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
              {.meaning = "path of a scene file, or `none`: an empty floor", .required = true});
  DeclareStart(fields, c);
  fields.OptionalGroup(
      "goal", &c->has_goal,
      {.meaning =
           "where the walk shall end; planned in place of `footsteps`, one of them is required"},
      [&](Fields& f) { DeclareGoal(f, &c->goal); });
  fields.List("footsteps",
              {.meaning = "in the order of stepping, at least one unless there is a `goal`",
               .max_items = 10000},
              &c->footsteps, DeclareFootstep);
  if (c->footsteps.empty() && !c->has_goal) {
    fields.Complain("footsteps", "there are none (valid: at least one, or a `goal`)");
  }
  if (!c->footsteps.empty() && c->has_goal) {
    fields.Complain("goal", "there are footsteps as well (valid: either of them)");
  }
  fields.Group("planner", {.meaning = "of the way to the goal"},
               [&](Fields& f) { DeclarePlanner(f, &c->planner); });
  fields.Renamed("half_steps", "step_set");
  fields.Group("step_set", {.meaning = "places that the planner chooses from"},
               [&](Fields& f) { DeclareHalfStepSet(f, &c->half_step_grid); });
  fields.Group("swept_volumes", {.meaning = "that are baked of them"},
               [&](Fields& f) { DeclareSweptVolumes(f, &c->swept_volumes); });
  fields.Group("half_step", {.meaning = "the isolated half-step"}, [&](Fields& f) {
    DeclareHalfStep(f, &c->half_step);
    if (c->has_goal && c->half_step.compensation > 0) {
      f.Complain("compensation",
                 "swept volumes are of half-steps without it (valid: `none` with a "
                 "`goal`)");
    }
  });
  fields.Group("smoothing", {.meaning = "the homotopy"}, [&](Fields& f) {
    DeclareSmoothing(f, &c->smoothing);
    const std::string complaint = ComplaintAboutFixed(*c);
    if (!complaint.empty()) f.Complain("fixed", complaint);
    if (c->has_goal && c->smoothing.repair_plan) {
      f.Complain("repair_plan",
                 "plans to a goal are of steps that were proved (valid: `false` with a `goal`)");
    }
  });
  fields.Group("output", {.meaning = "what is written"}, [&](Fields& f) {
    f.Text("directory", &c->output_directory,
           {.meaning = "the run folder, relative to the config",
            .otherwise = "`runs/NAME` in the working directory"});
    f.Number("period_s", &c->output_period,
             {.meaning = "between rows of trajectory.csv", .unit = "s", .min = 1e-4, .max = 1});
  });
  fields.Integer("seed", &c->seed,
                 {.meaning = "of the planner's random numbers and of random starts",
                  .min = 0,
                  .max = 2147483647});
}

void DeclareFilesThere(Fields& fields, const ExperimentConfig& config) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(RobotPath(config), ignored)) {
    std::string shipped;
    for (const auto& path : YamlFiles(RobotsFolder())) shipped += path.stem().string() + ", ";
    fields.Complain("robot", "no such robot: " + Quote(config.robot) + " (valid: " + shipped +
                                 "or the path of a robot file, relative to this file)");
  }
  const std::optional<std::filesystem::path> scene = ScenePath(config);
  if (scene && !std::filesystem::is_regular_file(*scene, ignored)) {
    fields.Complain("scene", "no such file: " + Quote(scene->string()) +
                                 " (valid: `none`, or a path relative to this file)");
  }
}

HalfStepShape ShapeOf(const HalfStepConfig& config) {
  return {.shift = config.zmp_shift / config.duration,
          .horizontal_delay = config.horizontal_delay,
          .bump_ramp = config.zmp_bump_ramp,
          .foot_ramp = config.foot_ramp,
          .lift_share = config.lift_share,
          .support_offset = config.support_offset};
}

std::vector<FixedParameter> FixedParameters(const SmoothingConfig& config) {
  std::vector<FixedParameter> fixed;
  for (const FixedConfig& one : config.fixed) {
    for (const ParameterFamily family : AllParameterFamilies()) {
      if (one.parameter == Traits(family).name)
        fixed.push_back({{family, one.index - 1}, one.value});
    }
  }
  return fixed;
}

std::vector<KeyDescription> ConfigKeys() {
  ExperimentConfig config;
  std::vector<KeyDescription> keys =
      DescribeKeys([&config](Fields& fields) { DeclareFields(fields, &config); });
  DescribeScaling(&keys);
  return keys;
}

ExperimentConfig LoadConfig(const std::string& path, const std::vector<YamlOverride>& overrides) {
  return ParseConfig(path, ReadYamlFile(path), overrides);
}

ExperimentConfig ParseConfig(const std::string& path, const std::string& text,
                             const std::vector<YamlOverride>& overrides) {
  const std::filesystem::path file(path);
  ExperimentConfig config;
  config.name = file.stem().string();
  ReadYamlText(text, path, file.parent_path().string(), overrides, [&](Fields& fields) {
    DeclareFields(fields, &config);
    fields.Misplaced("live", "this is the config of an episode (valid: `halfstep live` takes it)");
    config.directory = fields.directory();
    DeclareFilesThere(fields, config);
  });
  return config;
}

}  // namespace halfstep
