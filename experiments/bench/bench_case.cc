#include "experiments/bench/bench_case.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "experiments/bench/bench_footsteps.h"
#include "experiments/config/folder_name.h"
#include "experiments/run/experiment_run.h"
#include "experiments/run/plan_yaml.h"
#include "experiments/run/planning.h"
#include "smoothing/proof/certified_feasibility.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

// Smooths and certifies what the config walks. False when stopped.
bool SmoothInto(const ExperimentConfig& config, const std::stop_token& stop, BenchRow* row) {
  const RunHooks hooks{
      .progress = [](const std::string&, double) {}, .stop = stop, .stop_step = stop};
  ExperimentRun run(config, hooks);
  if (run.refusal()) {
    row->status = run.refusal()->status;
    row->message = run.refusal()->sentence;
    return true;
  }
  run.Smooth(hooks);
  if (stop.stop_requested()) return false;
  run.Certify(stop);
  if (stop.stop_requested()) return false;
  const MethodRun &raw = run.runs().front(), &last = run.runs().back();
  row->raw = raw.duration;
  row->certified = last.certified.answer.verdict == Verdict::kFeasible;
  if (row->certified && HasOwnResult(last.result.ending)) row->smoothed = last.duration;
  return true;
}

// How far the waist is below where it stands upright, at most [m].
double LowestWaist(const ExperimentConfig& config) {
  double lowest = config.half_step.crouch;
  for (const FootstepConfig& footstep : config.footsteps) {
    lowest = std::max(lowest, footstep.crouch.value_or(0.0));
  }
  return lowest;
}

std::optional<BenchRow> PlanCase(const BenchSelection& selection, const BenchCase& one,
                                 const fs::path& scenes, const std::stop_token& stop) {
  std::vector<YamlOverride> overrides = selection.overrides;
  overrides.push_back({"planner.name", one.planner});
  const ExperimentConfig config =
      LoadConfig((scenes / (one.key.Name() + ".yaml")).string(), overrides, selection.tools);
  BenchRow row;
  const Place place = LoadPlace(config);
  const PlannedWalk walk = PlanWalk(config, place, {.stop = stop});
  if (stop.stop_requested()) return std::nullopt;
  row.status = Name(walk.plan.status);
  row.message = walk.plan.sentence;
  row.nodes = static_cast<double>(walk.plan.nodes);
  row.effort = walk.plan.effort() + walk.proof_effort;
  row.wall = walk.plan.time;
  if (walk.plan.footsteps.empty()) return row;
  row.footsteps = static_cast<int>(walk.plan.footsteps.size());
  row.crouch = LowestWaist(walk.config);
  row.footsteps_yaml = PlanYaml(walk);
  if (!SmoothInto(walk.config, stop, &row)) return std::nullopt;
  return row;
}

// What is wrong with footsteps from elsewhere, as a status and in words; the half-steps one after
// the other are certified before anything is smoothed.
bool IsRefused(const Experiment& experiment, const GoalRegion& goal, BenchRow* row) {
  const HalfStepSequence& sequence = experiment.sequence;
  const Acceptance accepted = CertifyPlan(
      CertifiedFeasibility(
          MarginEvaluator(experiment.robot, experiment.scene, experiment.config.smoothing.limits),
          experiment.config.smoothing.certification),
      sequence);
  if (!accepted.accepted) {
    row->status = "not_certified";
    row->message =
        Formatted("the half-steps of footstep %d are not certified", accepted.refused_footstep + 1);
    return true;
  }
  std::array<Foothold, 2> feet = sequence.start;
  for (const Footstep& step :
       FootstepsOf(experiment.config, experiment.robot, *experiment.scene.ground)) {
    Nth(feet, Index(step.side)) = step.X_WF;
  }
  if (goal.ContainsStance(feet)) return false;
  const Eigen::Vector2d end = MidFeet(feet[0].Planar(), feet[1].Planar()).position();
  row->status = "does_not_arrive";
  row->message = Formatted("the last stance is %.3g m from the goal", goal.Distance(end));
  return true;
}

std::optional<BenchRow> CheckCase(const BenchSelection& selection, const BenchCase& one,
                                  const fs::path& scenes, const std::stop_token& stop) {
  BenchRow row;
  const fs::path scene = scenes / (one.key.Name() + "_scene.yaml");
  const GivenFootsteps given =
      ReadGivenFootsteps(selection, one.key, scene.string(), ReadBenchConfig(scenes, one.key));
  row.status = given.status;
  row.message = given.message;
  if (!given.config) return row;
  const ExperimentConfig with_goal =
      LoadConfig((scenes / (one.key.Name() + ".yaml")).string(), {}, selection.tools);
  const Experiment experiment = Prepare(*given.config);
  const GoalRegion goal = GoalOn(with_goal.goal, *experiment.scene.ground);
  row.crouch = LowestWaist(*given.config);
  if (IsRefused(experiment, goal, &row)) return row;
  row.status = "solved";
  row.message = "certified, and arrives";
  row.footsteps = experiment.sequence.num_steps();
  if (!SmoothInto(*given.config, stop, &row)) return std::nullopt;
  return row;
}

}  // namespace

std::vector<BenchKey> KeysOf(const BenchSelection& selection) {
  std::vector<BenchKey> keys;
  for (const std::string& kind : selection.kinds) {
    for (const int difficulty : selection.difficulties) {
      for (int seed = 1; seed <= selection.seeds; ++seed) keys.push_back({kind, difficulty, seed});
    }
  }
  return keys;
}

std::string BenchCase::Id() const { return key.Name() + "-" + MethodFolder(planner); }

std::vector<BenchCase> CasesOf(const BenchSelection& selection) {
  std::vector<std::string> planners = selection.planners;
  if (!selection.footsteps.empty()) planners = {"footsteps"};
  std::vector<BenchCase> cases;
  for (const BenchKey& key : KeysOf(selection)) {
    for (const std::string& planner : planners) cases.push_back({key, planner});
  }
  return cases;
}

void CheckOverrides(const BenchSelection& selection, const BenchSizes& sizes) {
  for (const YamlOverride& one : selection.overrides) {
    const std::string group = one.key.substr(0, one.key.find('.'));
    for (const std::string own : {"name", "robot", "scene", "start", "goal", "footsteps"}) {
      if (group != own && one.key != "planner.name") continue;
      throw InputError({"--set " + one.key +
                        ": is the benchmark's (valid: other keys; --robot and --planners choose)"});
    }
  }
  std::string config = DrawBenchScene(KeysOf(selection).front(), sizes, selection.robot).config;
  const size_t scene = config.find("\nscene: ") + 1;
  config.replace(scene, config.find('\n', scene) - scene, "scene: none");
  for (const std::string& planner : selection.planners) {
    std::vector<YamlOverride> overrides = selection.overrides;
    overrides.push_back({"planner.name", planner});
    ParseConfig("bench.yaml", config, overrides, selection.tools);
  }
}

std::optional<BenchRow> DoBenchCase(const BenchSelection& selection, const BenchCase& one,
                                    const fs::path& scenes, const std::stop_token& stop) {
  try {
    return selection.footsteps.empty() ? PlanCase(selection, one, scenes, stop)
                                       : CheckCase(selection, one, scenes, stop);
  } catch (const std::logic_error& error) {  // a mistake of ours: the other cases go on
    BenchRow row;
    row.status = "error";
    row.message = error.what();
    return row;
  }
}

}  // namespace halfstep
