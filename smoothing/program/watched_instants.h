#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "smoothing/margins/slack_evaluator.h"
#include "smoothing/program/overlap_variables.h"
#include "smoothing/program/row_order.h"
#include "smoothing/program/row_reserves.h"
#include "smoothing/program/slack_samples.h"
#include "smoothing/walk/stop_branches.h"
#include "smoothing/walk/stretch_range.h"
#include "wpg/nth.h"
#include "wpg/workers.h"

namespace halfstep {

/// Which instants are looked at, and how their slacks become rows.
struct WatchOptions {
  int instants = 32;      ///< per half-step, evenly spread over its own stretch
  double sharpness = 60;  ///< ρ > 0: a row lies at most log(count)/ρ below its least slack
  double cutoff = 1.5;    ///< c: statements with more slack do not count
  /// One row an instant and family instead of one a half-step and family.
  bool row_per_instant = false;
  StopBranches stop_branches = StopBranches::kNone;  ///< of which slacks are gathered as well
  StretchRange range = {};                           ///< what is not in it is not looked at
};

/// The slacks of a walk, gathered by half-step and family. Half-step k is looked at
///   - on its own stretch [t_k, t_{k+1}], at τ = u·(T_k − Δ_k) for fixed u ∈ (0, 1);
///   - where statements begin or end to count, at τ = v·T_k: lift-off or landing, begin or end of
///     the horizontal motion of its foot, which follows the delay of that motion;
///   - where a proof failed before (Learn) or samples show small slacks (Focus), at τ = v·T_k;
///   - where its stop branch is demanded, in the walk that is cut after it on [t_{k+1}, e_k], at
///     τ = T_k − (1 − u)·max(Δ_k, 0): before t_{k+1} that is the walk.
/// Row (k, family), or with `row_per_instant` (k, instant, family), is
///
///     −log(e^{−ρc} + Σ e^{−ρ·slack})/ρ − r ≤ min(c, least slack at these instants) − r,
///
/// so that a point that keeps it has the reserve r of its half-step and family, at first 3/ρ, for
/// what lies between the instants.
/// Smooth; rows of k depend on the variables of Band(k) only. Cost: linear in n.
/// Source: smoothing/README.md, "Overlap program".
class WatchedInstants {
 public:
  /// Both are borrowed.
  WatchedInstants(const OverlapVariables& variables, const MarginEvaluator& evaluator,
                  const WatchOptions& options);

  int rows() const { return first_rows_.back(); }  ///< number of rows
  int half_step_of(int row) const;                 ///< k of a row
  /// The family of a row; a half-step, or an instant, has one for each family that has its own.
  MarginFamily family_of(int row) const { return order_.family(row); }
  int NumRowFamilies() const { return order_.size(); }  ///< how many have a row of their own
  /// The variables on which the rows of a half-step depend (OverlapVariables::Band).
  const std::vector<int>& band(int half_step) const { return Nth(bands_, half_step); }
  /// Number of entries of the Jacobian: every row has those of its band.
  size_t num_nonzeros() const;

  const WatchOptions& options() const { return options_; }  ///< with the present sharpness
  double sharpness() const { return options_.sharpness; }   ///< ρ [1 / scale of a slack]
  /// Larger: nearer to the least slack, and less smooth. Every reserve is 3/ρ from now on.
  void SetSharpness(double sharpness);
  bool row_per_instant() const { return options_.row_per_instant; }  ///< as in WatchOptions
  /// Every reserve is `times` 3/ρ from now on.
  void SetReserves(double times);

  /// Half-steps and samples are shared out among `workers` (borrowed; null: none) from now on. What
  /// is found is the same, to the bit.
  void SetWorkers(Workers* workers) { workers_ = workers; }
  /// What is looked at is counted in `work` (borrowed; null: nowhere) from now on.
  void SetWork(Work* work) { work_ = work; }

  /// Adds an instant at which a slack turned out to be small, in the walk or in the stop branch
  /// after its half-step. Returns false when it, or one very near, is watched already.
  bool Learn(const SuperposedWalk& walk, const LocalTime& at, bool of_branch = false);
  /// Samples `walk`, and its stop branches, every `period` [s] and adds the instants that matter:
  /// those where a family's least slack has a local minimum in time, and some around it where that
  /// is near the `level` that all slacks are to reach. With `row_per_instant`, instants added so
  /// for earlier walks are dropped, and instants with no slack near the level get no row. Returns
  /// the least slack sampled in each half-step, at most 1 above the level.
  std::vector<double> Focus(const SuperposedWalk& walk, double period, double level);
  /// Adapts the reserves (RowReserves::Learn) to the walk of the last Focus: a proof refused it for
  /// `refusals`, none where it was proved; not `tried`: it was only sampled. Only with
  /// `row_per_instant`, and after a Focus; else nothing changes.
  void LearnReserves(bool tried, const std::vector<Margin>& refusals);

  /// Evaluates the rows at x (rows) and, unless `nonzeros` is null, the Jacobian, row by row in the
  /// order of its band.
  void Evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* values,
                std::vector<double>* nonzeros) const;

  /// The least slack at the instants, of the families in `of`, at most the cutoff.
  double LeastSlack(const HomotopyParameters& parameters,
                    const std::array<bool, kNumMarginFamilies>& of) const;

 private:
  struct Instant {
    enum class Of {
      kStretch,   // of T_k − Δ_k from t_k on
      kHalfStep,  // of T_k from t_k on
      kMotion,    // of T_k from t_k on; moves with the begin or end of the horizontal motion
      kFlight,    // the same with the begin or end of the flight
      kBranch,    // of Δ_k from t_{k+1} on, in the stop branch
    };
    enum class Why { kGrid, kLearned, kMinimum };
    double fraction;
    Of of;
    Why why = Why::kGrid;
    bool far = false;  // nothing there is near its limit: no row
  };
  // (k, τ) of an instant, and dτ along the parameters that move it.
  static LocalTime At(const SuperposedWalk& walk, int half_step, const Instant& instant,
                      ParameterRates* moving);
  static double StretchOf(const SuperposedWalk& walk, int half_step);  // its length [s]
  bool WatchesBranch(int half_step) const;
  bool Look(const SuperposedWalk& walk, const LocalTime& at, bool of_branch, Instant::Why why);
  // Focus on the walk, or on the new part of the stop branch after a half-step.
  void FocusOn(const SuperposedWalk& walk, std::optional<int> branch, double period, double level,
               std::vector<double>* least);
  void CountRows();
  // Adds what was looked at with `slacks` to the work.
  void Count(const std::vector<SlackEvaluator>& slacks) const;
  // One for each thread that SetWorkers allows.
  std::vector<SlackEvaluator> Evaluators(double cutoff, const ParameterFilter& wanted) const;
  double LeastSlackOf(const SuperposedWalk& walk, int half_step,
                      const std::array<bool, kNumMarginFamilies>& of, SlackEvaluator* slacks) const;
  void EvaluateOn(const SuperposedWalk& walk, const Eigen::VectorXd& x, Eigen::VectorXd* values,
                  std::vector<double>* nonzeros) const;
  // Begins to note what a walk shows (seen_) with its least rows, above the `level`.
  void NoteRows(const SuperposedWalk& walk, double level);
  // Adds what a sample of the walk shows of a half-step.
  void NoteSample(int half_step, const LeastSlacks& slacks, double level);
  void EvaluateHalfStep(const SuperposedWalk& walk, const Eigen::VectorXd& x, int half_step,
                        SlackEvaluator* slacks, Eigen::VectorXd* values, double* nonzeros) const;

  const OverlapVariables& variables_;
  const MarginEvaluator& evaluator_;
  RowOrder order_;
  WatchOptions options_;
  bool footsteps_move_ = false;  // whether any is a variable
  Workers* workers_ = nullptr;
  Work* work_ = nullptr;
  std::vector<std::vector<int>> bands_;
  std::vector<std::vector<Instant>> instants_;  // by half-step
  std::vector<int> first_rows_;                 // of each half-step, and the number of all
  RowReserves reserves_;
  RowReserves::Seen seen_;  // in the last Focus
};

}  // namespace halfstep
