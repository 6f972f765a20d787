#pragma once

#include "experiments/config/experiment.h"
#include "smoothing/methods/smoother.h"
#include "smoothing/methods/walk_problem.h"

namespace halfstep {

/// What an experiment smooths: its half-steps among its obstacles, with the margins, the kind of
/// acceptance and the fixed parameters of its config. Owns what it needs.
WalkProblem ProblemOf(const Experiment& experiment);

/// The options of its methods, each group as the config has it.
SmootherOptions OptionsOf(const ExperimentConfig& config);

}  // namespace halfstep
