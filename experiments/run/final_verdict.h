#pragma once

#include <stop_token>

#include "experiments/tables/result_tables.h"
#include "smoothing/methods/walk_problem.h"
#include "smoothing/proof/certified_feasibility.h"
#include "wpg/workers.h"

namespace halfstep {

/// Compares what a method says of its walk with what was found when the walk was certified: where
/// it says that it worked, and the problem's proof does not accept the walk, the run
/// becomes `failed` and not feasible, with a sentence. Stop branches are asked of where they are
/// demanded. Walks that are judged by samples stay as they are. Precondition:
/// `run->certified` is what `certifier` found. What is told to stop changes nothing.
void JudgeAtTheEnd(const WalkProblem& problem, const CertifiedFeasibility& certifier,
                   const std::stop_token& stop, Workers* workers, MethodRun* run);

}  // namespace halfstep
