#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/run/infeasible_plan.h"
#include "experiments/run/planning.h"
#include "experiments/tables/result_tables.h"
#include "experiments/tables/run_folder.h"
#include "smoothing/methods/walk_problem.h"
#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/proof/missed_demands.h"
#include "wpg/workers.h"

namespace halfstep {

/// Callbacks and stop tokens of a run. `progress` is called with what is under way ("plan", a
/// method) and the fraction of it that is done, which of a search by a solver is the used part of
/// its effort. A callback may come from another thread, never two at a time.
struct RunHooks {
  std::function<void(const std::string& what, double done)> progress;  ///< may be empty
  /// Called with the duration [s] of each walk that becomes a method's best; may be empty.
  std::function<void(const std::string& method, double duration)> best = {};
  std::stop_token stop;  ///< ends the run at the next safe point; what is proved by then stays
  std::stop_token stop_step = {};  ///< requested later; also ends a proof under way
  /// Called when the planned motion is found feasible: from then on there is something to keep.
  std::function<void()> keep = {};
  WalkReplayer replay = {};  ///< plays walks where the config asks for that; else may be empty
};

/// Why there is nothing to smooth.
struct RunRefusal {
  std::string status;    ///< "no_plan", "on_no_step_area"
  std::string sentence;  ///< in words, with what may help
};

/// A config on its way to a run folder: planned when it has a goal, smoothed with each method,
/// certified, written.
class ExperimentRun {
 public:
  /// Plans and loads, also the walk of the method `given`. Throws InputError, also for a config
  /// that asks for a replay where nothing plays walks.
  ExperimentRun(const ExperimentConfig& config, const RunHooks& hooks);
  ExperimentRun(const ExperimentRun&) = delete;
  ExperimentRun& operator=(const ExperimentRun&) = delete;

  /// None: there is something to smooth.
  const std::optional<RunRefusal>& refusal() const { return refusal_; }

  /// Runs every method. Precondition, as for all that follows: there is no refusal. All that
  /// follows needs Smooth() to have run.
  void Smooth(const RunHooks& hooks);
  /// Whether a method, or the user, wants the plan as a walk: `given` alone does not.
  bool wants_plan() const;

  /// Finds out why walks are not feasible, and what would help; trying ends with `stop`. Where it
  /// is not called, nothing of it is written.
  void Explain(const std::stop_token& stop);
  /// Samples and certifies every walk; those whose turn comes after a stop are undecided. A method
  /// that says that it worked, and whose walk is not accepted now, has failed (JudgeAtTheEnd).
  /// Must be called before Write().
  void Certify(const std::stop_token& stop);
  /// Plays every certified walk on simulated robots where the config asks for it. Must be called
  /// between Certify() and Write().
  void Replay(const RunHooks& hooks);

  /// The config with planned footsteps in place of a goal.
  const ExperimentConfig& config() const { return config_; }
  const Experiment& experiment() const { return *experiment_; }  ///< loaded from that config
  const WalkProblem& problem() const { return *problem_; }       ///< what the methods are given
  /// Of the problem, with the limits of the config.
  const MarginEvaluator& evaluator() const { return problem_->evaluator(); }
  /// One run for each method, "raw" first.
  const std::vector<MethodRun>& runs() const { return runs_; }

  /// What Explain() found of the planned motion, where it is wanted, and of the walk of the method
  /// `given`: those of them that are not feasible, in this order.
  const std::vector<InfeasibleWalk>& infeasible() const { return infeasible_; }

  /// What `smoothing.repair_plan` made of the plan: a sentence on each step that it changed, or
  /// could not make feasible. Empty: nothing was to repair, or nothing was asked for.
  const std::vector<std::string>& repaired() const { return repaired_; }

  /// As PlannedWalk::changed_half_step; "" where nothing was planned.
  std::string changed_half_step() const { return planned_ ? planned_->changed_half_step : ""; }

  /// Writes every file of a run folder.
  void Write(RunFolder* folder) const;

 private:
  void ReadGiven();
  void Repair(const RunHooks& hooks);
  MethodRun RunMethod(const std::string& name, const RunHooks& hooks);
  void WriteMethod(const MethodRun& run, const ExperimentConfig& named, RunFolder* folder) const;

  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  ExperimentConfig config_;
  std::optional<PlannedWalk> planned_;
  std::optional<RunRefusal> refusal_;
  std::optional<Experiment> experiment_;
  std::optional<WalkProblem> problem_;
  std::shared_ptr<Workers> workers_;  // null: the caller's thread only
  std::optional<CertifiedFeasibility> certifier_;
  std::vector<MethodRun> runs_;
  std::optional<MissedDemands> missed_, given_missed_;
  std::vector<InfeasibleWalk> infeasible_;
  std::optional<HomotopyParameters> given_;
  std::vector<std::string> repaired_;
};

/// Text of a config.yaml in a folder: with every key, paths relative to the folder.
std::string ResolvedConfig(const std::filesystem::path& folder, const ExperimentConfig& config);

}  // namespace halfstep
