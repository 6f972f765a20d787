#include "planner/search/termination.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace halfstep {

Termination AtTime(Clock clock, double end) {
  return [clock = std::move(clock), end](const PlanProgress&) {
    return clock() >= end ? StopReason::kClock : StopReason::kGoOn;
  };
}

Termination AfterNodes(std::int64_t nodes) {
  return [nodes](const PlanProgress& progress) {
    return progress.nodes >= nodes ? StopReason::kBudget : StopReason::kGoOn;
  };
}

Termination AfterEffort(double effort) {
  return [effort](const PlanProgress& progress) {
    return progress.effort() >= effort ? StopReason::kBudget : StopReason::kGoOn;
  };
}

Termination AtFirstPlan() {
  return [](const PlanProgress& progress) {
    return progress.has_plan() ? StopReason::kEnough : StopReason::kGoOn;
  };
}

Termination WhenNotImprovedFor(std::int64_t nodes) {
  return [nodes](const PlanProgress& progress) {
    return progress.has_plan() && progress.nodes_since_improvement >= nodes ? StopReason::kEnough
                                                                            : StopReason::kGoOn;
  };
}

Termination WhenPlannedAfter(double effort) {
  constexpr double kAsLong = 3.0;  // of what the first plan took
  return [effort, first = std::optional<double>()](const PlanProgress& progress) mutable {
    if (!progress.has_plan()) return StopReason::kGoOn;
    if (!first) first = progress.effort();
    return progress.effort() >= std::max(effort, kAsLong * *first) ? StopReason::kEnough
                                                                   : StopReason::kGoOn;
  };
}

Termination OnRequest(std::stop_token token) {
  return [token = std::move(token)](const PlanProgress&) {
    return token.stop_requested() ? StopReason::kInterrupted : StopReason::kGoOn;
  };
}

Termination AnyOf(std::vector<Termination> terminations) {
  return [terminations = std::move(terminations)](const PlanProgress& progress) {
    for (const Termination& termination : terminations) {
      const StopReason reason = termination(progress);
      if (reason != StopReason::kGoOn) return reason;
    }
    return StopReason::kGoOn;
  };
}

}  // namespace halfstep
