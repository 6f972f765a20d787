#pragma once

#include <memory>

#include "halfstep/experiments/config/experiment.h"
#include "halfstep/smoothing/methods/smoother.h"
#include "halfstep/smoothing/proof/feasibility_test.h"

namespace halfstep {

/// How the config says that candidates are judged: certified or sampled, with stop branches or not.
std::shared_ptr<const FeasibilityTest> FeasibilityTestOf(const Experiment& experiment);

/// The options of all methods as the config has them.
SmootherOptions SmootherOptionsOf(const ExperimentConfig& config);

}  // namespace halfstep
