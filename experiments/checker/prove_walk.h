#pragma once

#include "experiments/checker/walk_run.h"
#include "experiments/verify/walk_prover.h"

namespace halfstep::checker {

/// What `halfstep verify` has proved of walks: CheckRun of what its tables say.
verify::WalkProver ProverOfWalks();

}  // namespace halfstep::checker
