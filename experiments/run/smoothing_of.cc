#include "experiments/run/smoothing_of.h"

#include <memory>

#include "smoothing/methods/solver_method_options.h"
#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/proof/sampled_feasibility.h"
#include "smoothing/proof/stoppable_feasibility.h"

namespace halfstep {
namespace {

std::shared_ptr<const FeasibilityTest> TestOf(const Experiment& experiment) {
  const SmoothingConfig& config = experiment.config.smoothing;
  const MarginEvaluator evaluator(experiment.robot, experiment.scene, config.limits);
  std::shared_ptr<const FeasibilityTest> test;
  if (config.acceptance == "sampled") {
    test = std::make_shared<SampledFeasibility>(evaluator, config.sampling);
  } else {
    test = std::make_shared<CertifiedFeasibility>(evaluator, config.certification);
  }
  for (const StopBranches branches : {StopBranches::kDown, StopBranches::kAll}) {
    if (config.stop_branches == Name(branches)) {
      return std::make_shared<StoppableFeasibility>(test, branches);
    }
  }
  return test;
}

}  // namespace

WalkProblem ProblemOf(const Experiment& experiment) {
  return {experiment.sequence, TestOf(experiment), FixedParameters(experiment.config.smoothing)};
}

std::shared_ptr<Workers> WorkersOf(const ExperimentConfig& config) {
  if (config.smoothing.threads == 1) return nullptr;
  return std::make_shared<Workers>(config.smoothing.threads);
}

}  // namespace halfstep
