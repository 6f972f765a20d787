#pragma once

#include <array>
#include <vector>

#include "smoothing/margins/slack_evaluator.h"
#include "smoothing/walk/stretch_range.h"
#include "wpg/workers.h"

namespace halfstep {

/// The least slack of each family at an instant, at most a cutoff.
using LeastSlacks = std::array<double, kNumMarginFamilies>;

/// Where SampledSlacks looks.
struct SampleOptions {
  double begin = 0.0;   ///< of the first sample [s]
  double period = 0.0;  ///< from one to the next [s], > 0
  double cutoff = 0.0;  ///< slacks above it count as it
};

/// Least slacks of a walk at `begin`, a `period` later, … and at its end; the cutoff at instants of
/// half-steps that are not in `range`. Says nothing of what lies between. Samples are shared out
/// among `workers` (may be null), and counted in `work` (may be null).
std::vector<LeastSlacks> SampledSlacks(const SuperposedWalk& walk, const MarginEvaluator& evaluator,
                                       const StretchRange& range, const SampleOptions& options,
                                       Workers* workers, Work* work = nullptr);

/// The least slack of the families that have a local minimum in time at sample i; none:
/// `otherwise`.
double LocalMinimum(const std::vector<LeastSlacks>& samples, int i, double otherwise);

}  // namespace halfstep
