#pragma once

#include <optional>

#include "smoothing/methods/smoothing_monitor.h"

namespace halfstep {

/// Options of CoordinateAscent.
struct CoordinateAscentOptions {
  ParameterChoice parameters;  ///< coordinates beside the overlaps; durations only fall
  int passes = 10;             ///< ≥ 1, at most
  double tolerance = 0.001;    ///< of each bisection; a pass that gains less is the last [s] > 0
  /// Where to begin, instead of at the planned motion.
  std::optional<HomotopyParameters> start = std::nullopt;
};

/// Passes over the steps of a walk, left to right; each coordinate is bisected while the others
/// stay, and only the stretches that it changes are checked:
///   - Δ up, towards its natural bound;
///   - T down: with the overlaps as they are, and then with the two beside it in proportion, as far
///     as that gains; overlaps above their new natural bounds are lowered to them;
///   - η by itself changes no duration. So each of a few values is tried with the overlaps and
///     durations of its step and its neighbours' junctions bisected again, and kept if that gains.
/// Every point that is kept was found feasible by the problem's test and lasts no longer than the
/// one before. It ends where no coordinate gains by itself, which need not be an optimum. Endings
/// as for Dichotomy; one iterate for each pass.
SmoothingResult CoordinateAscent(const WalkProblem& problem, const CoordinateAscentOptions& options,
                                 SmoothingMonitor& monitor);

}  // namespace halfstep
