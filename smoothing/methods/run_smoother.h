#pragma once

#include <string>

#include "smoothing/methods/smoother.h"

namespace halfstep {

/// Runs a smoother that may be anyone's, and believes nothing that was not judged. What it throws
/// ends it as kFailed with what was thrown, and the best walk that its monitor accepted stays, or
/// the problem's start. A walk that it returns without its having been accepted is judged here:
/// where the problem's test refuses it, the result keeps it, is not feasible and kFailed, with the
/// witness. Throws InputError where the smoother does, and nothing else of it.
[[nodiscard]] SmoothingResult RunSmoother(const Smoother& smoother, const WalkProblem& problem,
                                          const MethodOptions& options, SmoothingMonitor& monitor);

/// What is to be said of a result whose walk the test did not accept, but its method did not say
/// so: the verdict with its witness, and the message that the result had.
std::string UnprovedSentence(const WalkProblem& problem, const Feasibility& answer,
                             const SmoothingResult& result);

}  // namespace halfstep
