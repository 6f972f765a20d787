#pragma once

#include <functional>
#include <optional>
#include <stop_token>

#include "smoothing/methods/smoothing_result.h"
#include "smoothing/proof/feasibility_test.h"
#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

struct CoordinateAscentOptions {
  bool heights = false;    ///< η are coordinates beside the overlaps
  bool durations = false;  ///< so are T
  double least_height_scale = 0.2;
  double least_duration = 0.5;  ///< as a fraction of the planned one
  int passes = 10;              ///< ≥ 1, at most
  double tolerance = 0.001;     ///< of each bisection; a pass that gains less is the last [s] > 0
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
/// Every point that is kept was found feasible by `test` and lasts no longer than the one before.
/// It ends where no coordinate gains by itself, which need not be an optimum. Endings as for
/// Dichotomy; one iterate for each pass.
SmoothingResult CoordinateAscent(const HalfStepSequence& sequence, const FeasibilityTest& test,
                                 const CoordinateAscentOptions& options,
                                 const std::function<void(double)>& progress = {},
                                 std::stop_token stop = {});

}  // namespace halfstep
