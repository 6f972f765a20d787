#pragma once

#include "opt/solvers/solver.h"
#include "smoothing/methods/overlap_optimizer.h"
#include "smoothing/methods/search_ending.h"
#include "smoothing/methods/smoothing_monitor.h"
#include "smoothing/program/overlap_program.h"

namespace halfstep {

/// From where SearchWhole begins its rounds, and how long it goes on.
struct RestartPolicy {
  int poor_rounds = 5;        ///< in a row that end the rounds from a start
  bool planned_start = true;  ///< whether there are rounds from the planned motion, too
  bool repeats = true;  ///< whether rounds begin again at the incumbent, as long as that gains
};

/// Lowers the cost of the monitor's incumbent, which is proved, by `program` over the whole walk.
/// In rounds from each start (the incumbent, the planned motion, random points, the incumbent
/// again) the solver takes a few steps; where they end is a candidate for the Incumbent, and the
/// program learns to look where the test refused it and where sampling finds small slacks. Ends
/// when rounds stopped to gain, at the options' deadline on the monitor's clock, or when it is
/// stopped. Tells progress from `from` on. Returns whether a walk of its own, proved as a whole, is
/// the incumbent now. `ending` notes how the solves ended. Source: smoothing/README.md, "The
/// incumbent".
bool SearchWhole(const WalkProblem& problem, const OptimizerOptions& options,
                 const opt::Solver& solver, const RestartPolicy& restarts, double from,
                 OverlapProgram* program, SmoothingMonitor& monitor, SearchEnding* ending);

}  // namespace halfstep
