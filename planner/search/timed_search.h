#pragma once

#include <functional>
#include <vector>

#include "planner/search/step_search.h"

namespace halfstep {

/// SearchSteps in time: states carry when they are reached and the safe interval in which they may
/// be kept [Phillips2011], edges rest as long as they have to, and the cost is the duration of the
/// walk. Of states in one cell that may be kept equally long, the earliest counts; with a weight
/// above 1 the first that was reached, and the search with the next weight, at last with 1, says
/// whether there is more. Precondition: request.times. The rest as SearchSteps.
bool SearchStepsInTime(const std::vector<StepState>& starts,
                       const std::function<StepsToGo(const StepState&)>& to_go,
                       const StepSearchOptions& options, const PlanRequest& request,
                       StepGraph* graph, PlanMonitor* monitor);

}  // namespace halfstep
