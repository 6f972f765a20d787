#pragma once

#include <memory>
#include <optional>
#include <string>

#include "opt/solvers/solver.h"
#include "smoothing/methods/smoothing_monitor.h"
#include "smoothing/program/overlap_program.h"

namespace halfstep {

/// Options of the methods that are solvers.
struct OptimizerOptions {
  std::string solver = "ipopt";  ///< one of opt::SolverNames(), or the name of `own_solver`
  std::shared_ptr<const opt::Solver> own_solver = nullptr;  ///< where set: in its place
  ProgramOptions program;  ///< what is solved, and over which parameters
  /// Where to begin, instead of at the dichotomy's result.
  std::optional<HomotopyParameters> start = std::nullopt;
  /// For `safest`, the most that D may be [s]; 0: the duration of the walk that it begins with.
  double duration_limit = 0.0;
  /// Before it solves for the whole walk, `fastest` with forms or footsteps lets a solver that
  /// likes many rows (SolverTraits::many_rows) go through walks of more than 6 half-steps in
  /// windows.
  bool windows = true;
  bool planned_start = true;  ///< solve also from the planned motion, for `fastest` shortened
  int random_starts = 0;      ///< and from random points of the variables' box
  unsigned seed = 1;          ///< of the random starts
  int rounds = 40;  ///< ≥ 1: most solves from each start; the program is refined between them
  /// Instants per half-step at which the program looks. 0: 24 where each of them makes rows of its
  /// own (SolverTraits::many_rows), else those of `program`.
  int instants = 0;
  /// The most iterations of the solver in a round; 0: SolverTraits::iterations. NLopt's solvers
  /// count none, so this does not bound them.
  int max_iterations = 0;
  double deadline = 30.0;    ///< of all solves together [s]
  double tolerance = 0.001;  ///< of the dichotomies before and after [s]
};

/// Smooths a whole sequence by a nonlinear program. Whatever the solver does, what is returned was
/// found feasible by the problem's test, and its cost with it:
///   1. the planned motion is the first incumbent, the result of a dichotomy the next (a coarse one
///      for `fastest`), unless a feasible `start` is given;
///   2. `fastest` that also moves forms or footsteps goes through longer walks in windows
///      (SearchWindows) and then, where these leave half of the time, searches a second time
///      without windows from where it began; the shorter walk counts. Shorter walks, and that
///      second search, are searched over fewer families first, in half of the time: over all but
///      footsteps, before that with forms as planned, too;
///   3. rounds over the whole walk, from there and from other starts (SearchWhole);
///   4. where time is left, 2 and 3 in longer windows; the shorter walk counts;
///   5. `fastest`: a dichotomy's pass from the incumbent over all junctions, with `tolerance`, and
///      without a `start` one from the planned motion, too.
/// So no method ends worse than the dichotomy. Ending: kConverged when rounds stopped to gain from
/// every start; kLimit when all rounds were used, or the last solve broke down; kNoImprovement,
/// kInvalidInput, kFailed (every solve did) and kNotRun when what is returned does not come from
/// the search. The message says how the last solve ended.
SmoothingResult OptimizeOverlaps(const WalkProblem& problem, const OptimizerOptions& options,
                                 SmoothingMonitor& monitor);

}  // namespace halfstep
