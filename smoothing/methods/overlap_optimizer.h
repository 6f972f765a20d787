#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "opt/solvers/solver.h"
#include "smoothing/methods/search_stages.h"
#include "smoothing/methods/search_tuning.h"
#include "smoothing/methods/smoothing_monitor.h"
#include "smoothing/program/overlap_program.h"

namespace halfstep {

/// Options of the methods that are solvers.
struct OptimizerOptions {
  std::string solver = "ipopt";  ///< one of opt::SolverNames(), or the name of `own_solver`
  std::shared_ptr<const opt::Solver> own_solver = nullptr;  ///< where set: in its place
  ProgramOptions program;                     ///< what is solved, and over which parameters
  SearchStart start = SearchStart::kTypical;  ///< where rounds begin; `safest`: at the dichotomy's
  /// A feasible walk to begin at, in place of `start` and of the planned motion.
  std::optional<HomotopyParameters> begin = std::nullopt;
  /// For `safest`, the most that D may be [s]; 0: the duration of the walk that it begins with.
  double duration_limit = 0.0;
  bool windows = true;  ///< long walks are searched in windows first
  /// Only in windows, as these say, and never over the whole.
  std::optional<SearchStage> only = std::nullopt;
  int rounds = 40;  ///< ≥ 1: most solves from each start; the program is refined between them
  /// Instants per half-step at which the program looks. 0: those of `tuning` where each of them
  /// makes rows of its own (SolverTraits::many_rows), else those of `program`.
  int instants = 0;
  /// The most iterations of the solver in a round; 0: SolverTraits::iterations. NLopt's solvers
  /// count none, so this does not bound them.
  int max_iterations = 0;
  double effort = 5.0;  ///< of all solves and proofs together (Work::effort)
  /// An emergency stop [s]: what it ends is not the same twice.
  double deadline = std::numeric_limits<double>::infinity();
  double tolerance = 0.001;  ///< of the dichotomies before and after [s]
  SearchTuning tuning;       ///< what else there is to choose
};

/// Smooths a whole sequence by a nonlinear program. Whatever the solver does, what is returned was
/// found feasible by the problem's test, and its cost with it:
///   1. the planned motion, or `begin`, is the first incumbent; the result of a dichotomy the next
///      where the search is to start there. Where the planned motion is not feasible and the search
///      starts at typical forms, the first walk that it proves is the first incumbent (FindFirst);
///   2. the stages of the search (RunStages): rounds in windows on long walks, then over the whole;
///   3. `fastest`: a dichotomy's pass from the incumbent over all junctions, with `tolerance`, and
///      one from the planned motion where that might still be shorter.
/// So no method ends worse than the dichotomy. Ending: kConverged when rounds stopped to gain from
/// every start; kLimit when the effort or all rounds were used, or the last solve broke down;
/// kNoImprovement, kInvalidInput, kFailed (every solve did) and kNotRun when what is returned does
/// not come from the search, which is the planned motion, not feasible, where no walk was proved.
/// The message says how the last solve ended.
SmoothingResult OptimizeOverlaps(const WalkProblem& problem, const OptimizerOptions& options,
                                 SmoothingMonitor& monitor);

}  // namespace halfstep
