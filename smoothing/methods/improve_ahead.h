#pragma once

#include <memory>
#include <optional>

#include "smoothing/methods/smoothing_monitor.h"
#include "smoothing/program/overlap_program.h"
#include "smoothing/walk/splice.h"

namespace halfstep {

/// Options of ImproveAhead.
struct AheadOptions {
  int window = 6;                       ///< half-steps that are moved together; even, ≥ 2
  ParameterChoice choice = {};          ///< what is moved beside their overlaps
  int rounds = 4;                       ///< ≥ 1: most solves
  std::string solver = "halfstep/sqp";  ///< one of opt::SolverNames()
  double least_gain = 0.01;  ///< a walk that is shorter by less is not worth a change [s]
};

/// Shortens what has not begun of a walk in execution: the `window` half-steps from the step of
/// half-step `first` on, with the first of them beginning when it did. Returns a walk that agrees
/// with `walk` until half-step `first` begins, lasts at least `least_gain` less, and was proved by
/// `test` where it changed, with the stop branches there if `test` demands them; none when none was
/// found before the monitor was to stop. Half-steps behind the window begin earlier, otherwise as
/// they did.
///
/// Precondition: `test` proves `walk` from when `first` begins on, at its own times. What is behind
/// the window is not looked at again where obstacles rest, or are the better known the earlier
/// (Scene::OnlyGrowsFrom); among others it is. `test` decides at any time: a CertificationScope
/// with times would be one of another walk's. Throws std::logic_error unless 0 ≤ first < n, or for
/// options out of their ranges. Source: smoothing/README.md, "Windows".
std::optional<HomotopyParameters> ImproveAhead(const WalkPlan& walk,
                                               std::shared_ptr<const FeasibilityTest> test,
                                               int first, const AheadOptions& options,
                                               SmoothingMonitor& monitor);

}  // namespace halfstep
