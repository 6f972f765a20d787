#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/replay/run_replay.h"
#include "experiments/report/report.h"
#include "experiments/run/complete_manifest.h"
#include "experiments/run/experiment_run.h"
#include "experiments/run/infeasible_plan.h"
#include "experiments/run/interrupt.h"
#include "experiments/run/progress_bar.h"
#include "experiments/run/run_screen.h"
#include "wpg/files/input_error.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

// A bar for one thing after the other.
class ProgressBars {
 public:
  explicit ProgressBars(bool quiet) : quiet_(quiet) {}

  void Update(const std::string& what, double done) { Of(what).Update(done); }
  void Best(const std::string& what, double duration) { Of(what).Best(duration); }
  void End() { bar_.reset(); }
  /// The methods whose progress is the share of their effort; dichotomies go by junctions.
  void CountEffortOf(const std::vector<std::string>& methods) {
    for (const std::string& method : methods) {
      if (!method.starts_with("dichotomy")) counted_.insert(method);
    }
  }

 private:
  ProgressBar& Of(const std::string& what) {
    if (!bar_ || what != what_) {
      bar_.reset();
      bar_.emplace(what, quiet_, counted_.contains(what) ? " of the effort" : "");
      what_ = what;
    }
    return *bar_;
  }

  const bool quiet_;
  std::set<std::string> counted_;
  std::string what_;
  std::optional<ProgressBar> bar_;
};

// What became of steps that were to be repaired, on standard error.
void TellRepaired(const ExperimentRun& run) {
  for (const std::string& sentence : run.repaired()) std::cerr << "halfstep: " << sentence << '\n';
}

// Whether every method found a walk, whatever the planned motion is.
bool AllFound(const ExperimentRun& run) {
  const auto methods = std::span(run.runs()).subspan(1);
  return !methods.empty() &&
         std::ranges::all_of(methods, [](const MethodRun& each) { return each.result.feasible; });
}

// Why the plan is not feasible, or the given walk, and what would help.
void TellInfeasible(const ExperimentRun& run) {
  bool told = !run.wants_plan() || run.runs().front().result.feasible;
  for (const InfeasibleWalk& walk : run.infeasible()) {
    const bool given = walk.method == "given";
    told = told || !given;
    TellUnder(given           ? "the given walk is not feasible; worst first:"
              : AllFound(run) ? "the plan is not feasible, though every method found a walk; "
                                "what the plan misses, worst first:"
                              : "the plan is not feasible; worst first:",
              InfeasibleText(run.problem(), walk));
  }
  if (told) return;  // else it was stopped before that was known
  std::cerr << "halfstep: the plan is not feasible: " << run.runs().front().result.message << '\n';
}

// Whether what the walk of the method `given` misses was told.
bool TellsGiven(const ExperimentRun& run) {
  return std::ranges::any_of(run.infeasible(),
                             [](const InfeasibleWalk& walk) { return walk.method == "given"; });
}

// A sentence on standard error for each method that never searched or broke down.
bool TellWhatDidNotWork(const ExperimentRun& whole, bool wants_plan) {
  bool did_not = false;
  for (const MethodRun& run : whole.runs()) {
    if (!DidNotWork(run.result.ending)) continue;
    if (run.method == "raw" && (!wants_plan || AllFound(whole))) continue;
    did_not = true;
    if (run.method == "given" && TellsGiven(whole)) continue;  // told already
    std::cerr << "halfstep: " << run.method << ": " << Name(run.result.ending) << ": "
              << run.result.message << '\n';
  }
  return did_not;
}

// "[dichotomy, ipopt]": the value of smoothing.methods.
std::string MethodList(const std::vector<std::string>& methods,
                       const std::vector<std::string>& known) {
  std::string list;
  for (const std::string& method : methods) {
    if (std::find(known.begin(), known.end(), method) == known.end()) {
      throw InputError(
          {"--method " + Quote(method) + ": no such method" + Suggestion(method, known)});
    }
    list += (list.empty() ? "" : ", ") + method;
  }
  return "[" + list + "]";
}

}  // namespace

ExitStatus Run(const RunCommand& command) {
  InterruptGuard interrupt;
  ProgressBars bars(command.quiet || command.json);
  std::vector<YamlOverride> overrides = command.overrides;
  if (!command.methods.empty()) {
    overrides.push_back(
        {"smoothing.methods", MethodList(command.methods, command.tools.methods.Names())});
  }
  const ExperimentConfig config = LoadConfig(command.config, overrides, command.tools);
  const std::filesystem::path out = OutputFolder(command, config);
  // A folder that may not be replaced is told before anything is planned.
  if (!command.overwrite && std::filesystem::exists(std::filesystem::symlink_status(out))) {
    const RunFolder refused(out, false);
  }
  bars.CountEffortOf(config.smoothing.methods);
  const RunHooks hooks{
      .progress = [&bars](const std::string& what, double done) { bars.Update(what, done); },
      .best = [&bars](const std::string& method, double walk) { bars.Best(method, walk); },
      .stop = interrupt.token(),
      .stop_step = interrupt.step_token(),
      .keep = [&interrupt] { interrupt.Keep(); },
      .replay = replay::ReplayerOf(config)};
  ExperimentRun run(config, hooks);
  if (run.refusal()) {
    bars.End();
    std::cerr << "halfstep: " << run.refusal()->sentence << '\n';
    return interrupt.requested() ? kInterrupted : kFailed;
  }
  RunFolder folder(out, command.overwrite);
  run.Smooth(hooks);
  bars.End();
  const bool wants_plan = run.wants_plan();
  const bool feasible = run.runs().front().result.feasible || !wants_plan || AllFound(run);
  TellRepaired(run);
  run.Explain(interrupt.step_token());
  TellInfeasible(run);  // before the tables, which take longer
  // What smoothing had found when it was stopped is proved all the same.
  run.Certify(interrupt.requested() ? interrupt.proof_token() : interrupt.token());
  run.Replay(hooks);
  bars.End();
  run.Write(&folder);
  WriteReport(run.experiment().robot, run.experiment().scene, &folder, command.tools);
  CompleteManifest(run.experiment().robot, run.experiment().scene, &folder);
  folder.Publish();

  TellWarnings(run.experiment().robot, run.experiment().scene);
  const std::string place = folder.path().string();
  if (command.json) {
    std::cout << RunJson(run.experiment(), run.problem(), run.runs(), run.infeasible(), place);
  } else if (!command.quiet) {
    if (const std::string changed = run.changed_half_step(); !changed.empty()) {
      std::cout << "planned with half_step: {" << changed
                << "}, which the ground or an obstacle asks for\n";
    }
    std::cout << RunTable(run.experiment(), run.problem(), run.runs(),
                          {place, "not_covered in certificate.json"});
    const std::filesystem::path report = folder.path() / "report.html";
    if (std::filesystem::exists(report)) std::cout << "report:  " << report.string() << '\n';
  }
  if (!feasible) return kFailed;
  if (interrupt.requested()) return kInterrupted;
  return TellWhatDidNotWork(run, wants_plan) ? kFailed : kSuccess;
}

CommandAction DeclareRun(CLI::App* app, const Toolbox& tools) {
  const auto command = std::make_shared<RunCommand>();
  command->tools = tools;
  const auto sets = std::make_shared<std::vector<std::string>>();
  app->add_option("CONFIG", command->config, "experiment, a YAML file or a shipped one's name")
      ->required();
  DeclareMethods(app, command.get());
  DeclareOverrides(app, "the config", sets.get());
  app->add_option("--out", command->out, "run folder (default: output.directory, or runs/NAME)");
  DeclareRunFlags(app, command.get());
  return [command, sets] {
    command->overrides = ParseOverrides(*sets);
    return Run(*command);
  };
}

void DeclareMethods(CLI::App* app, RunCommand* command) {
  app->add_option("--method", command->methods, "in place of smoothing.methods; repeatable")
      ->allow_extra_args(false);
}

void DeclareRunFlags(CLI::App* app, RunCommand* command) {
  app->add_flag("--overwrite", command->overwrite, "replace an older run");
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  app->add_flag("--json", command->json, "print the summary as JSON");
}

}  // namespace halfstep
