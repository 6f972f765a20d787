#pragma once

#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "smoothing/margins/margin_evaluator.h"

namespace halfstep {

/// Mistakes that the footsteps of a config seem to have, a sentence each, so that they are told
/// before the symptoms that they cause: feet that change sides (left and right exchanged), places
/// far out of reach (other units), turns that no hip makes, two footsteps of one foot in a row, and
/// feet that start or land in an obstacle that rests. None of them is proved to be a mistake; what
/// is certain is refused when the config is read. `evaluator` is of the same robot and scene.
std::vector<std::string> LookAtFootsteps(const Experiment& experiment,
                                         const MarginEvaluator& evaluator);

/// The same of a config with a goal: feet that start on each other's side or in an obstacle, and a
/// goal in which no place of a sole is free of no-step areas and resting obstacles, of some hundred
/// places that are tried.
std::vector<std::string> LookAtGoal(const ExperimentConfig& config,
                                    const MarginEvaluator& evaluator);

}  // namespace halfstep
