#pragma once

#include "smoothing/methods/overlap_optimizer.h"

namespace halfstep {

/// Options of ParetoCurve.
struct ParetoOptions {
  int points = 8;              ///< ≥ 2, durations in geometric progression
  double most_duration = 1.0;  ///< of the planned motion's: where the curve ends
};

/// The trade-off between how safe a walk is and how long it lasts: solves `fastest`, then `safest`
/// with D at most the dichotomy's own duration and at most durations from the fastest to the
/// longest, each from the one before. Every point was proved, with its least slack, by the
/// problem's test. The result's parameters are those of the point at the dichotomy's own duration;
/// `pareto` holds the points by duration, less those that a shorter walk is as safe as. All solves
/// together have the effort of `options`.
SmoothingResult ParetoCurve(const WalkProblem& problem, const OptimizerOptions& options,
                            const ParetoOptions& pareto, SmoothingMonitor& monitor);

}  // namespace halfstep
