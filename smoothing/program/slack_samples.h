#pragma once

#include <array>
#include <vector>

#include "smoothing/margins/slack_evaluator.h"
#include "smoothing/walk/stretch_range.h"

namespace halfstep {

/// The least slack of each family at an instant, at most a cutoff.
using LeastSlacks = std::array<double, kNumMarginFamilies>;

/// Least slacks of a walk at `begin` [s], a `period` [s] later, … and at its end; the cutoff at
/// instants of half-steps that are not in `range`. Says nothing of what lies between.
std::vector<LeastSlacks> SampledSlacks(const SuperposedWalk& walk, const MarginEvaluator& evaluator,
                                       const StretchRange& range, double begin, double period,
                                       double cutoff);

/// The least slack of the families that have a local minimum in time at sample i; none:
/// `otherwise`.
double LocalMinimum(const std::vector<LeastSlacks>& samples, int i, double otherwise);

}  // namespace halfstep
