#include "experiments/run/experiment_run.h"
#include "experiments/run/plan_json.h"

#include <algorithm>
#include <ctime>
#include <limits>

#include "experiments/config/folder_name.h"
#include "experiments/run/final_verdict.h"
#include "experiments/run/manifest.h"
#include "experiments/run/plan_volumes.h"
#include "experiments/run/smoothing_of.h"
#include "experiments/tables/given_walk_file.h"
#include "experiments/tables/parameter_tables.h"
#include "experiments/tables/run_inputs.h"
#include "smoothing/methods/given_walk.h"
#include "smoothing/methods/overlap_prices.h"
#include "smoothing/methods/plan_repair.h"
#include "smoothing/methods/run_smoother.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// Between the rows of a walk's trajectory.csv [s]. Rows that are played straight from one to the
// next cut the corners of a ZMP that shifts within few of them.
double RowPeriod(const ExperimentConfig& config, const MethodRun& run) {
  const HomotopyParameters& walk = run.result.parameters;
  double quickest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < walk.durations.size(); ++i) {
    quickest = std::min(quickest, walk.zmp_shifts[i] * walk.durations[i]);
  }
  return config.output_period.value_or(quickest < kCoarseRows * kRowPeriod ? kFineRowPeriod
                                                                           : kRowPeriod);
}

// The planned motion as the first row of every comparison, and what it misses.
MethodRun PlannedRun(const WalkProblem& problem, const std::stop_token& stop, Workers* workers,
                     std::optional<MissedDemands>* missed) {
  MethodRun run("raw");
  MarginEvaluator::Scratch scratch = problem.evaluator().MakeScratch();
  scratch.stop = stop;
  scratch.workers = workers;
  const SuperposedWalk walk(problem.sequence(), PlannedMotion(problem.sequence()));
  const Feasibility answer = problem.test().Check(walk, {0.0, walk.duration()}, &scratch);
  run.result.parameters = walk.parameters();
  run.result.cost = walk.duration();
  run.result.evidence = problem.test().evidence();
  run.result.work = scratch.work;
  run.result.collision_queries = scratch.bodies.queries;
  run.result.feasible = answer.verdict == Verdict::kFeasible;
  if (answer.stopped) {
    run.result.message = "stopped from outside before the start was looked at";
    return run;
  }
  if (run.result.feasible) {
    run.result.ending = opt::Ending::kConverged;
    run.result.message = "the isolated half-steps, one after the other";
    return run;
  }
  *missed = FindMissedDemands(problem.evaluator(), walk, answer.witness);
  run.result.ending = opt::Ending::kFailed;
  run.result.message = problem.evaluator().Describe((*missed)->demands.front().worst);
  return run;
}

// Of all threads of this process so far [s].
double ProcessorSeconds() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

bool TakesGiven(const ExperimentConfig& config) {
  return std::ranges::find(config.smoothing.methods, "given") != config.smoothing.methods.end();
}

}  // namespace

ExperimentRun::ExperimentRun(const ExperimentConfig& config, const RunHooks& hooks)
    : config_(config) {
  if (config.has_replay && !hooks.replay) {
    throw InputError(
        {"replay: walks are not simulated here (valid: in `halfstep run` and `sweep`)"});
  }
  Place place = LoadPlace(config);
  if (config.has_goal) {
    planned_ = PlanWalk(
        config, place,
        {.progress = [&](const std::string&, double done) { hooks.progress("plan", done); },
         .stop = hooks.stop});
    if (planned_->plan.footsteps.empty()) {
      refusal_ = {"no_plan", "no walk: " + planned_->plan.sentence};
      return;
    }
    config_ = planned_->config;
  }
  experiment_ = Prepare(config_, std::move(place));
  config_.smoothing.limits = experiment_->config.smoothing.limits;
  if (const auto stepped_on = FootholdOnNoStep(*experiment_)) {
    refusal_ = {"on_no_step_area", "the plan is not feasible: " + *stepped_on};
  }
  ReadGiven();
}

void ExperimentRun::ReadGiven() {
  if (!TakesGiven(config_)) return;
  given_ =
      ReadGivenWalk(GivenPaths(config_), experiment_->sequence, FixedParameters(config_.smoothing));
}

// Steps that were repaired are footsteps of the config with a duration and a height of their own.
void ExperimentRun::Repair(const RunHooks& hooks) {
  const PlanRepair repair =
      RepairPlan(experiment_->sequence, ProblemOf(*experiment_).test(), {}, hooks.stop_step);
  for (const PlanChange& change : repair.steps) {
    const FootstepConfig& footstep = Nth(config_.footsteps, *change.step);
    repaired_.push_back(Formatted(
        "footstep %d was repaired: %.3f s in place of %.3f s, %.3f m "
        "high in place of %.3f m",
        *change.step + 1, *change.duration, footstep.duration.value_or(config_.half_step.duration),
        *change.via_height, footstep.via_height.value_or(config_.half_step.via_height)));
  }
  config_ = Changed(std::move(config_), repair.steps);
  for (const std::string& failure : repair.failures) repaired_.push_back(failure);
  if (repair.steps.empty()) return;
  experiment_ = Prepare(config_, {experiment_->robot, experiment_->scene});
  ReadGiven();  // what it does not say is as planned, which is something else now
}

void ExperimentRun::Smooth(const RunHooks& hooks) {
  if (config_.smoothing.repair_plan) Repair(hooks);
  problem_ = ProblemOf(*experiment_);
  certifier_.emplace(evaluator(), config_.smoothing.certification);
  workers_ = WorkersOf(config_);
  runs_ = {PlannedRun(*problem_, hooks.stop_step, workers_.get(), &missed_)};
  for (const std::string& sentence : repaired_) runs_.front().result.message += "; " + sentence;
  if (hooks.keep && runs_.front().result.feasible) hooks.keep();
  for (const std::string& name : config_.smoothing.methods) {
    runs_.push_back(RunMethod(name, hooks));
  }
}

MethodRun ExperimentRun::RunMethod(const std::string& name, const RunHooks& hooks) {
  MethodRun run(name);
  SmoothingMonitor monitor({.progress =
                                [&](double done) {
                                  if (hooks.progress) hooks.progress(name, done);
                                },
                            .stop = hooks.stop,
                            .stop_proof = hooks.stop_step,
                            .workers = workers_,
                            .on_incumbent =
                                [&](const HomotopyParameters& walk) {
                                  if (hooks.best) hooks.best(name, DurationOf(walk));
                                }});
  MethodOptions options = config_.smoothing.options;
  options.Edit(GivenWalkGroup()) = given_;
  const double begin = ProcessorSeconds();
  run.result = RunSmoother(config_.smoothing.known.Find(name), *problem_, options, monitor);
  run.processor = ProcessorSeconds() - begin;
  const SuperposedWalk walk(experiment_->sequence, run.result.parameters);
  if (missed_ && run.result.ending == opt::Ending::kNotRun &&
      run.result.parameters == runs_.front().result.parameters) {
    run.result.message = "the planned motion is not feasible: " + runs_.front().result.message;
  }
  if (name == "given" && run.result.ending == opt::Ending::kFailed) {
    MarginEvaluator::Scratch scratch = evaluator().MakeScratch();
    scratch.stop = hooks.stop_step;
    const Feasibility answer = problem_->test().Check(walk, {0.0, walk.duration()}, &scratch);
    if (answer.stopped) return run;
    given_missed_ = FindMissedDemands(evaluator(), walk, answer.witness);
    run.result.message = "the given walk is not feasible: " +
                         evaluator().Describe(given_missed_->demands.front().worst);
  }
  AddPrices(walk, evaluator(), &run.result.junctions);
  return run;
}

bool ExperimentRun::wants_plan() const {
  const std::vector<std::string>& methods = config_.smoothing.methods;
  return methods.empty() ||
         std::ranges::any_of(methods, [](const std::string& method) { return method != "given"; });
}

void ExperimentRun::Explain(const std::stop_token& stop) {
  infeasible_.clear();
  if (missed_ && wants_plan()) {
    infeasible_.push_back(ExplainPlan(*experiment_, *problem_, *missed_, stop));
  }
  if (given_missed_) {
    infeasible_.push_back({.method = "given", .inputs = {}, .missed = *given_missed_, .help = {}});
  }
}

void ExperimentRun::Certify(const std::stop_token& stop) {
  for (MethodRun& run : runs_) {
    SampleTrajectory(evaluator(), experiment_->sequence, RowPeriod(config_, run), &run);
    run.certified = CertifyWalk(*certifier_, experiment_->sequence, run.result.parameters, stop,
                                workers_.get());
    JudgeAtTheEnd(*problem_, *certifier_, stop, workers_.get(), &run);
  }
}

void ExperimentRun::Replay(const RunHooks& hooks) {
  if (!config_.has_replay) return;
  for (MethodRun& run : runs_) {
    if (run.certified.answer.verdict != Verdict::kFeasible) continue;
    const auto same = std::ranges::find_if(runs_, [&run](const MethodRun& other) {
      return other.trajectory.text == run.trajectory.text;
    });
    if (&*same != &run) {  // a method that kept another one's walk
      run.replay = same->replay;
      continue;
    }
    hooks.progress("replay of " + run.method, 0.0);
    run.replay = hooks.replay(*experiment_, run.trajectory.text, hooks.stop);
  }
}

void ExperimentRun::WriteMethod(const MethodRun& run, const ExperimentConfig& named,
                                RunFolder* folder) const {
  const std::string place = MethodFolder(run.method) + "/";
  WriteCsv(place + "trajectory", run.trajectory, folder);
  WriteCsv(place + "half_steps", HalfStepsCsv(experiment_->sequence, run.result.parameters),
           folder);
  WriteCertificate(*experiment_, *certifier_, run.certified, named, run.trajectory.text, place,
                   folder);
  if (run.result.junctions.empty()) return;
  WriteCsv(place + "overlaps", OverlapsCsv(evaluator(), run), folder);
  WriteCsv(place + "iterates", IteratesCsv(run), folder);
  if (run.result.pareto.empty()) return;
  WriteCsv(place + "pareto", ParetoCsv(evaluator(), experiment_->sequence, run), folder);
}

void ExperimentRun::Write(RunFolder* folder) const {
  ExperimentConfig written = WithInputs(config_, experiment_->robot, experiment_->scene, folder);
  for (const MethodRun& run : runs_) WriteMethod(run, written, folder);
  if (TakesGiven(config_)) {  // the run holds the given walk itself
    written.smoothing.given.overlaps = (folder->path() / "given/overlaps.csv").string();
    written.smoothing.given.half_steps = (folder->path() / "given/half_steps.csv").string();
  }
  const std::string resolved = ResolvedConfig(folder->path(), written);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin_;
  folder->Write("config.yaml", resolved);
  if (planned_) {
    folder->Write("plan.json", PlanJson(*planned_));
    if (planned_->half_steps.cached.volumes && !planned_->plan.footsteps.empty()) {
      folder->Write("swept_volumes.json", PlanVolumesJson(*planned_, experiment_->sequence));
    }
  }
  WriteCsv("footsteps", FootstepsCsv(experiment_->sequence), folder);
  if (!infeasible_.empty()) {
    folder->Write("infeasible.json", InfeasibleJsonText(*problem_, infeasible_));
  }
  WriteCsv("summary", SummaryCsv(evaluator(), runs_, config_.has_replay), folder);
  folder->Write("manifest.json", ManifestJson(*experiment_, resolved,
                                              problem_->test().Description(), runs_, wall.count()));
}

std::string ResolvedConfig(const std::filesystem::path& folder, const ExperimentConfig& config) {
  ExperimentConfig moved = MovedTo(folder, config);
  return WriteYaml([&](Fields& fields) { DeclareFields(fields, &moved); });
}

}  // namespace halfstep
