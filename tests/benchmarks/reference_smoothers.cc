#include "tests/benchmarks/reference_smoothers.h"

#include <memory>
#include <string>

#include "smoothing/methods/smoother_registry.h"
#include "tests/benchmarks/coordinate_ascent.h"
#include "tests/benchmarks/reference_search.h"

namespace halfstep {
namespace {

class CoordinateSmoother : public Smoother {
 public:
  std::string name() const override { return "coordinate"; }
  std::string meaning() const override {
    return "passes over overlaps, heights and durations, each bisected in turn";
  }
  OptionGroup options() const override { return OptionGroup::kOptimizer; }
  SmoothingResult Smooth(const WalkProblem& problem, const SmootherOptions& options,
                         SmoothingMonitor& monitor) const override {
    monitor.LimitTo(options.optimizer.deadline);
    return CoordinateAscent(problem,
                            {.parameters = options.optimizer.program.parameters,
                             .tolerance = options.optimizer.tolerance},
                            monitor);
  }
};

class GridSmoother : public Smoother {
 public:
  std::string name() const override { return "reference"; }
  std::string meaning() const override {
    return "dynamic programming over a grid of parameters; slow";
  }
  OptionGroup options() const override { return OptionGroup::kOptimizer; }
  SmoothingResult Smooth(const WalkProblem& problem, const SmootherOptions& options,
                         SmoothingMonitor& monitor) const override {
    monitor.LimitTo(options.optimizer.deadline);
    ReferenceOptions reference{.parameters = options.optimizer.program.parameters};
    const bool more = reference.parameters.heights || reference.parameters.durations;
    if (more && problem.scene().rests()) {
      for (const char* method : {"dichotomy/uniform", "coordinate"}) {
        SmoothingMonitor within(monitor.Part(0.0, 0.0));
        reference.starts.push_back(
            FindSmoother(method).Smooth(problem, options, within).parameters);
      }
    }
    return ReferenceSearch(problem, reference, monitor);
  }
};

}  // namespace

void RegisterReferenceSmoothers() {
  RegisterSmoother(std::make_shared<CoordinateSmoother>());
  RegisterSmoother(std::make_shared<GridSmoother>());
}

}  // namespace halfstep
