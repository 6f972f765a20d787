#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "experiments/commands.h"
#include "experiments/experiment.h"
#include "experiments/interrupt.h"
#include "experiments/manifest.h"
#include "experiments/methods.h"
#include "experiments/planning.h"
#include "experiments/progress_bar.h"
#include "experiments/report/report.h"
#include "experiments/result_tables.h"
#include "experiments/run_folder.h"
#include "experiments/run_screen.h"
#include "smoothing/certified_feasibility.h"
#include "smoothing/explain.h"
#include "smoothing/sampled_feasibility.h"
#include "wpg/input/input_error.h"

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
  run.result.status = feasible ? SmoothingStatus::kFinished : SmoothingStatus::kStartInfeasible;
  run.result.message = feasible ? "the isolated half-steps, one after the other"
                                : test.evaluator().Describe(answer.witness);
  return run;
}

void WriteRun(const Experiment& experiment, const CertifiedFeasibility& certifier,
              const MethodRun& run, RunFolder* folder) {
  const MarginEvaluator& evaluator = certifier.evaluator();
  const std::string place = MethodFolder(run.method) + "/";
  WriteCsv(place + "trajectory", run.trajectory, folder);
  WriteCsv(place + "half_steps", HalfStepsCsv(experiment.sequence, run), folder);
  WriteCertificate(experiment, certifier, run.certified, run.trajectory.text, place, folder);
  if (run.result.junctions.empty()) return;
  WriteCsv(place + "overlaps", OverlapsCsv(evaluator, run), folder);
  WriteCsv(place + "iterates", IteratesCsv(run), folder);
  if (run.result.pareto.empty()) return;
  WriteCsv(place + "pareto", ParetoCsv(evaluator, experiment.sequence, run), folder);
}

std::unique_ptr<FeasibilityTest> MakeTest(const MarginEvaluator& evaluator,
                                          const SmoothingConfig& config) {
  if (config.acceptance == "sampled") {
    return std::make_unique<SampledFeasibility>(evaluator, config.sampling);
  }
  return std::make_unique<CertifiedFeasibility>(evaluator, config.certification);
}

PlannedWalk PlanForRun(const ExperimentConfig& config, const RunCommand& command,
                       std::stop_token stop) {
  ProgressBar bar("plan", command.quiet || command.json);
  return PlanWalk(config,
                  {.progress = [&bar](const std::string&, double done) { bar.Update(done); },
                   .stop = std::move(stop)});
}

MethodOptions OptionsOf(const ExperimentConfig& config) {
  const OptimizerConfig& optimizer = config.smoothing.optimizer;
  MethodOptions options{config.smoothing.dichotomy, optimizer.options, {}};
  options.optimizer.seed = static_cast<unsigned>(config.seed);
  if (optimizer.program == "pareto") options.pareto = optimizer.pareto;
  return options;
}

std::filesystem::path OutputFolder(const RunCommand& command, const ExperimentConfig& config) {
  if (command.out && command.out->empty()) {
    throw InputError({"--out: no folder is named (valid: a path)"});
  }
  if (command.out) return *command.out;
  if (!config.output_directory.empty()) {
    return std::filesystem::path(config.directory) / config.output_directory;
  }
  return std::filesystem::path("runs") / config.name;
}

}  // namespace

ExitStatus Run(const RunCommand& command) {
  const auto begin = std::chrono::steady_clock::now();
  InterruptGuard interrupt;
  ExperimentConfig config = LoadConfig(command.config, command.overrides);
  std::optional<PlannedWalk> planned;
  if (config.has_goal) {
    planned = PlanForRun(config, command, interrupt.token());
    if (planned->plan.footsteps.empty()) {
      std::cerr << "halfstep: no walk: " << planned->plan.sentence << '\n';
      return interrupt.requested() ? kInterrupted : kFailed;
    }
    config = planned->config;
  }
  const Experiment experiment = Prepare(config);
  if (const auto stepped_on = FootprintOnNoStep(experiment)) {
    std::cerr << "halfstep: the plan is not feasible: " << *stepped_on << '\n';
    return kFailed;
  }
  RunFolder folder(OutputFolder(command, config), command.overwrite);

  const MarginEvaluator evaluator(experiment.robot, experiment.scene, config.smoothing.limits);
  const std::unique_ptr<FeasibilityTest> accepts = MakeTest(evaluator, config.smoothing);
  const FeasibilityTest& test = *accepts;
  const CertifiedFeasibility certifier(evaluator, config.smoothing.certification);
  std::vector<MethodRun> runs = {PlannedRun(experiment, test)};
  for (const std::string& name : config.smoothing.methods) {
    ProgressBar bar(name, command.quiet || command.json);
    MethodRun run(name);
    run.result = FindMethod(name).smooth(
        experiment.sequence, test, OptionsOf(config), [&bar](double done) { bar.Update(done); },
        interrupt.token());
    AddPrices(SuperposedWalk(experiment.sequence, run.result.parameters), evaluator,
              &run.result.junctions);
    runs.push_back(std::move(run));
  }
  for (MethodRun& run : runs) {
    SampleTrajectory(evaluator, experiment.sequence, config.output_period, &run);
    run.certified = CertifyWalk(certifier, experiment.sequence, run.result.parameters);
    WriteRun(experiment, certifier, run, &folder);
  }
  ExperimentConfig moved = MovedTo(folder.path(), config);
  const std::string resolved = WriteYaml([&](Fields& fields) { DeclareFields(fields, &moved); });
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  folder.Write("config.yaml", resolved);
  if (planned) folder.Write("plan.json", PlanJson(*planned));
  WriteCsv("footsteps", FootstepsCsv(experiment.sequence), &folder);
  WriteCsv("summary", SummaryCsv(evaluator, runs), &folder);
  folder.Write("manifest.json",
               ManifestJson(experiment, resolved, test.Description(), runs, wall.count()));
  WriteReport(experiment.robot, experiment.scene, &folder);
  folder.Publish();

  if (command.json) {
    std::cout << RunJson(evaluator, runs, folder.path().string());
  } else if (!command.quiet) {
    std::cout << RunTable(experiment, evaluator, test, runs, folder.path().string());
  }
  for (const MethodRun& run : runs) {
    if (run.result.status != SmoothingStatus::kStartInfeasible) continue;
    std::cerr << "halfstep: the plan is not feasible: " << runs.front().result.message << '\n';
    return kFailed;
  }
  return interrupt.requested() ? kInterrupted : kSuccess;
}

}  // namespace halfstep
