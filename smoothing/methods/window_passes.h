#pragma once

#include "opt/solvers/solver.h"
#include "smoothing/methods/search_ending.h"
#include "smoothing/methods/smoothing_monitor.h"
#include "smoothing/program/overlap_program.h"

namespace halfstep {

/// Options of SearchWindows.
struct WindowPassesOptions {
  int window = 6;  ///< half-steps that are moved together; even, ≥ 2
  int step = 4;    ///< half-steps by which the next window lies further on; even, 2 … window
  int passes = 6;  ///< ≥ 1: over the whole walk at most
  ProgramOptions program;  ///< `fastest` or `smooth`
  double deadline = 30.0;  ///< on the monitor's clock [s]
};

/// Lowers the cost of the monitor's incumbent, which is proved, by SearchWindow in windows from its
/// first half-step to its last, again and again until a pass gains nothing. In the first pass
/// half-steps that no window has met begin as those a stride before have become (RepeatSteps). A
/// later pass takes only windows near which the one before gained something. A gain is proved by
/// the stretches that it changes, and adopted. In the end all stretches of the walk are proved
/// again, at their times in it; where that fails, the walk goes back a part of the way there. Tells
/// progress between `from` and `to`. Returns whether anything was gained; `ending` notes how solves
/// and passes ended. Source: smoothing/README.md, "Windows".
bool SearchWindows(const WalkProblem& problem, const WindowPassesOptions& options,
                   const opt::Solver& solver, double from, double to, SmoothingMonitor& monitor,
                   SearchEnding* ending);

}  // namespace halfstep
