#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "smoothing/methods/smoothing_monitor.h"
#include "smoothing/methods/walk_problem.h"

namespace halfstep {

/// A problem that `test` judges, which is borrowed.
inline WalkProblem ProblemOf(const HalfStepSequence& sequence, const FeasibilityTest& test,
                             std::vector<FixedParameter> fixed = {}) {
  return {sequence, std::shared_ptr<const FeasibilityTest>(std::shared_ptr<void>(), &test),
          std::move(fixed)};
}

/// What a method makes of a problem, with a monitor of its own: Smoothed(Dichotomy, problem, {}).
template <typename Options>
SmoothingResult Smoothed(SmoothingResult (*method)(const WalkProblem&, const Options&,
                                                   SmoothingMonitor&),
                         const WalkProblem& problem, const std::type_identity_t<Options>& options,
                         MonitorOptions monitor_options = {}) {
  SmoothingMonitor monitor(std::move(monitor_options));
  return method(problem, options, monitor);
}

}  // namespace halfstep
