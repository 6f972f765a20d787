#include "experiments/run/experiment_run.h"

#include "experiments/config/folder_name.h"
#include "experiments/config/methods.h"
#include "experiments/run/manifest.h"
#include "smoothing/methods/explain.h"
#include "smoothing/proof/sampled_feasibility.h"

namespace halfstep {
namespace {

// The planned motion as the first row of every comparison.
MethodRun PlannedRun(const Experiment& experiment, const FeasibilityTest& test) {
  MethodRun run("raw");
  MarginEvaluator::Scratch scratch = test.evaluator().MakeScratch();
  const SuperposedWalk walk(experiment.sequence, PlannedMotion(experiment.sequence));
  const Feasibility answer = test.Check(walk, {0.0, walk.duration()}, &scratch);
  run.result.parameters = walk.parameters();
  run.result.cost = walk.duration();
  run.result.evidence = test.evidence();
  run.result.instants = scratch.instants;
  run.result.collision_queries = scratch.bodies.queries;
  const bool feasible = answer.verdict == Verdict::kFeasible;
  run.result.feasible = feasible;
  if (answer.stopped) {
    run.result.ending = opt::Ending::kNotRun;
    run.result.message = "stopped from outside before the start was looked at";
    return run;
  }
  run.result.ending = feasible ? opt::Ending::kConverged : opt::Ending::kFailed;
  run.result.message = feasible ? "the isolated half-steps, one after the other"
                                : test.evaluator().Describe(answer.witness);
  return run;
}

std::unique_ptr<FeasibilityTest> MakeTest(const MarginEvaluator& evaluator,
                                          const SmoothingConfig& config, std::stop_token stop) {
  if (config.acceptance == "sampled") {
    return std::make_unique<SampledFeasibility>(evaluator, config.sampling, std::move(stop));
  }
  return std::make_unique<CertifiedFeasibility>(evaluator, config.certification, std::move(stop));
}

MethodOptions OptionsOf(const ExperimentConfig& config) {
  const OptimizerConfig& optimizer = config.smoothing.optimizer;
  MethodOptions options{config.smoothing.dichotomy, optimizer.options, {}};
  options.optimizer.seed = static_cast<unsigned>(config.seed);
  if (optimizer.program == "pareto") options.pareto = optimizer.pareto;
  return options;
}

}  // namespace

ExperimentRun::ExperimentRun(const ExperimentConfig& config, const RunHooks& hooks)
    : config_(config) {
  if (config.has_goal) {
    planned_ = PlanWalk(
        config, {.progress = [&](const std::string&, double done) { hooks.progress("plan", done); },
                 .stop = hooks.stop});
    if (planned_->plan.footsteps.empty()) {
      refusal_ = {"no_plan", "no walk: " + planned_->plan.sentence};
      return;
    }
    config_ = planned_->config;
  }
  experiment_ = Prepare(config_);
  if (const auto stepped_on = FootprintOnNoStep(*experiment_)) {
    refusal_ = {"on_no_step_area", "the plan is not feasible: " + *stepped_on};
  }
}

void ExperimentRun::Smooth(const RunHooks& hooks) {
  evaluator_.emplace(experiment_->robot, experiment_->scene, config_.smoothing.limits);
  test_ = MakeTest(*evaluator_, config_.smoothing, hooks.stop_step);
  certifier_.emplace(*evaluator_, config_.smoothing.certification);
  runs_ = {PlannedRun(*experiment_, *test_)};
  if (hooks.keep && runs_.front().result.feasible) hooks.keep();
  for (const std::string& name : config_.smoothing.methods) {
    MethodRun run(name);
    run.result = FindMethod(name).smooth(
        experiment_->sequence, *test_, OptionsOf(config_),
        [&](double done) { hooks.progress(name, done); }, hooks.stop);
    AddPrices(SuperposedWalk(experiment_->sequence, run.result.parameters), *evaluator_,
              &run.result.junctions);
    runs_.push_back(std::move(run));
  }
}

void ExperimentRun::Certify(const std::stop_token& stop) {
  for (MethodRun& run : runs_) {
    SampleTrajectory(*evaluator_, experiment_->sequence, config_.output_period, &run);
    run.certified = CertifyWalk(*certifier_, experiment_->sequence, run.result.parameters, stop);
  }
}

void ExperimentRun::WriteMethod(const MethodRun& run, RunFolder* folder) const {
  const std::string place = MethodFolder(run.method) + "/";
  WriteCsv(place + "trajectory", run.trajectory, folder);
  WriteCsv(place + "half_steps", HalfStepsCsv(experiment_->sequence, run), folder);
  WriteCertificate(*experiment_, *certifier_, run.certified, run.trajectory.text, place, folder);
  if (run.result.junctions.empty()) return;
  WriteCsv(place + "overlaps", OverlapsCsv(*evaluator_, run), folder);
  WriteCsv(place + "iterates", IteratesCsv(run), folder);
  if (run.result.pareto.empty()) return;
  WriteCsv(place + "pareto", ParetoCsv(*evaluator_, experiment_->sequence, run), folder);
}

void ExperimentRun::Write(RunFolder* folder) const {
  for (const MethodRun& run : runs_) WriteMethod(run, folder);
  const std::string resolved = ResolvedConfig(folder->path(), config_);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin_;
  folder->Write("config.yaml", resolved);
  if (planned_) folder->Write("plan.json", PlanJson(*planned_));
  WriteCsv("footsteps", FootstepsCsv(experiment_->sequence), folder);
  WriteCsv("summary", SummaryCsv(*evaluator_, runs_), folder);
  folder->Write("manifest.json",
                ManifestJson(*experiment_, resolved, test_->Description(), runs_, wall.count()));
}

std::string ResolvedConfig(const std::filesystem::path& folder, const ExperimentConfig& config) {
  ExperimentConfig moved = MovedTo(folder, config);
  return WriteYaml([&](Fields& fields) { DeclareFields(fields, &moved); });
}

}  // namespace halfstep
