#pragma once

#include <optional>

#include "smoothing/methods/smoothing_monitor.h"

namespace halfstep {

/// The dichotomies with which a search ends.
struct FineDichotomies {
  SmoothingResult from_incumbent;  ///< one pass over all junctions
  std::optional<SmoothingResult>
      from_start;  ///< the same from the problem's start; none: not asked
};

/// Runs them with `tolerance` [s], at the same time where the monitor has workers. Nothing is
/// adopted or counted.
FineDichotomies RunFineDichotomies(const WalkProblem& problem, double tolerance, bool from_start,
                                   SmoothingMonitor& monitor);

/// Counts the work of a search that was part of the monitor's, and makes its walk, its candidates
/// and its junctions the monitor's, where it is shorter than the incumbent or began at it.
void TakeSearch(const SmoothingResult& found, bool from_incumbent, SmoothingMonitor& monitor);

}  // namespace halfstep
