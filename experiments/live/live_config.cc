#include "experiments/live/live_config.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "experiments/config/data_folder.h"
#include "experiments/config/scaled_defaults.h"
#include "planner/search/step_set.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

std::string Listed(const std::vector<std::string>& names) {
  constexpr size_t kListed = 8;
  std::string text;
  for (size_t i = 0; i < std::min(names.size(), kListed); ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  return names.size() > kListed ? text + ", …" : text;
}

void DeclareSensing(Fields& fields, SensingConfig* c) {
  fields.Text("source", &c->source,
              {.meaning = "stand_in: frames of what the script says; client: what clients of "
                          "`halfstep live --serve` send",
               .choices = {"stand_in", "client"}});
  fields.Number("period_s", &c->period,
                {.meaning = "between frames", .unit = "s", .min = 0.005, .max = 10});
  fields.Number("delay_s", &c->delay,
                {.meaning = "from a frame to when it is known", .unit = "s", .min = 0, .max = 2});
  fields.Number("noise_m", &c->noise,
                {.meaning = "positions are drawn from a ball of this radius around the true ones",
                 .unit = "m",
                 .min = 0,
                 .max = 0.5});
  fields.Number(
      "error_m", &c->error,
      {.meaning = "what is assumed of that radius: r", .unit = "m", .min = 0, .max = 0.5});
  fields.OptionalNumber("rests_after_s", &c->rests_after,
                        {.meaning = "an obstacle that was measured at one place for so long is "
                                    "taken to rest until it is measured elsewhere; none: it may "
                                    "move at its speed at any time",
                         .unit = "s",
                         .min = 0,
                         .max = 3600});
  fields.Number("lost", &c->lost,
                {.meaning = "part of the frames that never arrives", .min = 0, .max = 1});
}

// `half_step`: its duration [s].
void DeclareBudget(Fields& fields, BudgetConfig* c, double half_step) {
  const auto time = [&](const char* key, double* value, const char* meaning) {
    fields.Number(key, value, {.meaning = meaning, .unit = "s", .min = 0, .max = 10});
  };
  time("check_s", &c->check, "what looking at the walk to come costs in lockstep");
  time("plan_s", &c->plan, "what planning anew costs in lockstep");
  time("smooth_s", &c->smooth, "what finding the overlaps of a few junctions costs in lockstep");
  fields.Misplaced("refine_s", "is gone with `refine` (leave it out)");
  fields.Number("effort_s", &c->effort,
                {.meaning = "a unit of counted effort takes so long, in place of the three above, "
                            "which then say how long answers are waited for; 0: these are charged",
                 .unit = "s",
                 .min = 0,
                 .max = 10,
                 .left_out = 0.0});
  for (const auto& [key, value] : {std::pair{"check_s", c->check}, std::pair{"plan_s", c->plan},
                                   std::pair{"smooth_s", c->smooth}}) {
    if (value >= half_step) {
      fields.Complain(key,
                      "is no shorter than a half-step: nothing could be handed over in time "
                      "(valid: below half_step.duration_s)");
    }
  }
}

// `scene`: what the script is about; null: not known yet.
void DeclareScript(Fields& fields, LiveOptions* c, const Scene* scene) {
  fields.List("script", {.meaning = "what happens, in the order of time", .max_items = 10000},
              &c->script, [scene](Fields& f, ScriptEvent* event) {
                DeclareFields(f, event);
                if (scene == nullptr) return;
                for (const SceneMistake& one : MistakesOf(*event, *scene)) {
                  f.Complain(one.key.c_str(), one.what);
                }
              });
  if (scene != nullptr) {
    for (const SceneMistake& one : MistakesOf(*c, *scene)) {
      fields.Complain(one.key.c_str(), one.what);
    }
  }
  if (c->sensing.source == "client" && !c->script.empty()) {
    fields.Complain("script",
                    "says what happens, but clients say what is measured (valid: [], or "
                    "sensing.source: stand_in)");
  }
  if (c->policy != "replan" && std::ranges::any_of(c->script, Commands)) {
    fields.Complain("script",
                    "commands a course in place of the goal (valid: with live.policy replan)");
  }
  if (!std::ranges::is_sorted(c->script, {}, &ScriptEvent::at)) {
    fields.Complain("script", "is not in the order of time (valid: at_s that do not fall)");
  }
}

void DeclareLive(Fields& fields, LiveOptions* c, double half_step, const Scene* scene) {
  fields.Text("clock", &c->clock,
              {.meaning = "lockstep: time stands still while the planner computes, and its budget "
                          "is charged; wall: it computes beside the walking robot",
               .choices = {"lockstep", "wall"}});
  fields.Text("policy", &c->policy,
              {.meaning = "what is done when the world changes",
               .choices = {"replan", "paper", "stop_and_replan"}});
  fields.Number("period_s", &c->period,
                {.meaning = "of control", .unit = "s", .min = 0.001, .max = 0.1});
  fields.Number("horizon_s", &c->horizon,
                {.meaning = "how long the uncertainty of a measurement grows; a half-step begins "
                            "only when it ends before that",
                 .unit = "s",
                 .min = 0.1,
                 .max = 60});
  fields.Number("drift_m_s", &c->drift,
                {.meaning = "the robot strays from where it believes to be at this speed",
                 .unit = "m/s",
                 .min = 0,
                 .max = 1});
  fields.Number(
      "longest_s", &c->longest,
      {.meaning = "the episode ends then at the latest", .unit = "s", .min = 1, .max = 3600});
  fields.Number("ahead_s", &c->ahead,
                {.meaning = "where a course is commanded in place of the goal, so much walk to "
                            "come is planned; 0: what two footsteps take without overlaps",
                 .unit = "s",
                 .min = 0,
                 .max = 60,
                 .left_out = 0.0});
  fields.Integer("spare_boxes", &c->spare_boxes,
                 {.meaning = "boxes of 0.2 x 0.2 x 0.1 m, spare_1 ..., that are not there until "
                             "something makes them appear",
                  .min = 0,
                  .max = 100});
  fields.Integer("smooth_at_once", &c->smooth_at_once,
                 {.meaning = "junctions whose overlaps are found in one go", .min = 1, .max = 100});
  fields.Integer("smooth_ahead", &c->smooth_ahead,
                 {.meaning = "overlaps are found so many junctions ahead", .min = 1, .max = 1000});
  fields.Number("down_up_cap", &c->down_up_cap,
                {.meaning = "largest overlap of a step with the next as a fraction of its natural "
                            "bound; 0.45: steps begin after the landing before them, so that in "
                            "physics none begins when that comes late",
                 .min = 0,
                 .max = 1});
  fields.Number("tolerance_s", &c->tolerance,
                {.meaning = "of these overlaps", .unit = "s", .min = 1e-4, .max = 0.5});
  fields.Misplaced("refine", "is gone, since it was not known to pay (leave it out)");
  fields.Group("sensing", {.meaning = "where measurements come from"},
               [&](Fields& f) { DeclareSensing(f, &c->sensing); });
  fields.Group("budget", {.meaning = "what thinking costs in lockstep"},
               [&](Fields& f) { DeclareBudget(f, &c->budget, half_step); });
  DeclareScript(fields, c, scene);
}

}  // namespace

double Ahead(const LiveConfig& config) {
  return config.live.ahead > 0.0 ? config.live.ahead : 4.0 * config.experiment.half_step.duration;
}

std::vector<std::string> SpareNames(const LiveOptions& options) {
  std::vector<std::string> names;
  for (int i = 1; i <= options.spare_boxes; ++i) names.push_back("spare_" + std::to_string(i));
  return names;
}

std::vector<SceneMistake> MistakesOf(const ScriptEvent& event, const Scene& scene) {
  std::vector<SceneMistake> mistakes;
  if (event.what == "forbid" && event.area > std::ssize(scene.no_step)) {
    mistakes.push_back(
        {"area", Formatted("%d: the scene has %zu no-step areas (valid: one of these)", event.area,
                           scene.no_step.size())});
  }
  std::vector<std::string> names;
  for (const Obstacle& obstacle : scene.obstacles) names.push_back(obstacle.name);
  if (!event.obstacle.empty() && std::ranges::find(names, event.obstacle) == names.end()) {
    mistakes.push_back(
        {"obstacle", Quote(event.obstacle) + " is not in the scene (valid: " +
                         (names.empty() ? "none, it has no obstacles" : Listed(names)) + ")"});
  }
  return mistakes;
}

std::vector<SceneMistake> MistakesOf(const LiveOptions& options, const Scene& scene) {
  std::vector<SceneMistake> mistakes;
  if (options.drift > 0.0 && !scene.no_step.empty()) {
    mistakes.push_back(
        {"drift_m_s", "the scene has no-step areas, whose place is taken as exact (valid: 0)"});
  }
  if (options.drift > 0.0 && HasLevels(*scene.ground)) {
    mistakes.push_back(
        {"drift_m_s", "the ground has levels, whose borders are taken as exact (valid: 0)"});
  }
  for (const std::string& name : SpareNames(options)) {
    if (std::ranges::count(scene.obstacles, name, &Obstacle::name) < 2) continue;
    mistakes.push_back({"spare_boxes", Quote(name) + " is an obstacle of the scene already (valid: "
                                                     "fewer, or another name in the scene)"});
  }
  return mistakes;
}

ExperimentConfig EpisodeDefaults() {
  ExperimentConfig config;
  config.planner.name = "rrt";
  return config;
}

void DeclareFields(Fields& fields, LiveConfig* config, const Scene* scene) {
  DeclareFields(fields, &config->experiment);
  fields.Group("live", {.meaning = "the episode", .required = true}, [&](Fields& f) {
    DeclareLive(f, &config->live, config->experiment.half_step.duration, scene);
  });
  if (config->experiment.has_replay) {
    fields.Complain("replay", "is of runs (valid: `halfstep replay` of the episode)");
  }
  if (config->experiment.smoothing.has_tube) {
    fields.Complain("smoothing",
                    "has a `tube`, but what is promised of an episode is of the walk as planned "
                    "(valid: without `tube`)");
  }
  if (!config->experiment.has_goal) {
    fields.Complain("goal", "is missing (valid: an episode needs a goal)");
  }
}

std::vector<KeyDescription> EpisodeKeys(Toolbox tools) {
  LiveConfig config;
  SetKnown(std::move(tools.methods), &config.experiment.smoothing);
  config.experiment.planner.known = std::move(tools.planners);
  std::vector<KeyDescription> keys =
      DescribeKeys([&config](Fields& fields) { DeclareFields(fields, &config); });
  DescribeScaling(&keys);
  return keys;
}

LiveConfig LoadLiveConfig(const std::string& path, const std::vector<YamlOverride>& overrides,
                          Toolbox tools) {
  const std::string file = FileOrShipped(path, "episodes").string();
  return ParseLiveConfig(file, ReadYamlFile(file), overrides, nullptr, std::move(tools));
}

LiveConfig ParseLiveConfig(const std::string& path, const std::string& text,
                           const std::vector<YamlOverride>& overrides, const Scene* scene,
                           Toolbox tools) {
  const std::filesystem::path file(path);
  LiveConfig config;
  config.experiment.name = file.stem().string();
  SetKnown(std::move(tools.methods), &config.experiment.smoothing);
  config.experiment.planner.known = std::move(tools.planners);
  ReadYamlText(text, path, file.parent_path().string(), overrides, [&](Fields& fields) {
    DeclareFields(fields, &config, scene);
    config.experiment.directory = fields.directory();
    DeclareFilesThere(fields, config.experiment);
  });
  return config;
}

}  // namespace halfstep
