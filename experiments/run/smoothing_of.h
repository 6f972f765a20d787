#pragma once

#include <memory>

#include "experiments/config/experiment.h"
#include "smoothing/methods/smoother.h"
#include "smoothing/methods/walk_problem.h"
#include "wpg/workers.h"

namespace halfstep {

/// What an experiment smooths: its half-steps among its obstacles, with the margins, the kind of
/// acceptance and the fixed parameters of its config. Owns what it needs.
WalkProblem ProblemOf(const Experiment& experiment);

/// The threads that its methods and proofs use beside the caller's; null: none.
std::shared_ptr<Workers> WorkersOf(const ExperimentConfig& config);

}  // namespace halfstep
