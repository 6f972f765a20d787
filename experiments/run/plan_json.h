#pragma once

#include <string>

#include "experiments/run/planning.h"

namespace halfstep {

/// Text of plan.json of a run folder; keys: experiments/files.md, "Run folder".
std::string PlanJson(const PlannedWalk& walk);

}  // namespace halfstep
