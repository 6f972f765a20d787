#include "tests/benchmarks/reference_smoothers.h"

#include <memory>
#include <string>
#include <vector>

#include "smoothing/methods/solver_method_options.h"
#include "tests/benchmarks/coordinate_ascent.h"
#include "tests/benchmarks/reference_search.h"

namespace halfstep {
namespace {

// With the options of `smoothing.optimizer`.
class ReferenceSmoother : public Smoother {
 public:
  std::vector<DeclaredGroup> groups() const override { return {OptimizerGroup()}; }
  void DeclareRequest(Fields& fields, MethodOptions options) const override {
    DeclareSolverRequest(fields, options.Get(OptimizerGroup()));
  }
};

class CoordinateSmoother : public ReferenceSmoother {
 public:
  std::string name() const override { return "coordinate"; }
  std::string meaning() const override {
    return "passes over overlaps, heights and durations, each bisected in turn";
  }
  SmoothingResult Smooth(const WalkProblem& problem, const MethodOptions& options,
                         SmoothingMonitor& monitor) const override {
    const OptimizerOptions optimizer = options.Get(OptimizerGroup()).options;
    monitor.LimitTo(optimizer.effort, optimizer.deadline);
    return CoordinateAscent(
        problem, {.parameters = optimizer.program.parameters, .tolerance = optimizer.tolerance},
        monitor);
  }
};

class GridSmoother : public ReferenceSmoother {
 public:
  std::string name() const override { return "reference"; }
  std::string meaning() const override {
    return "dynamic programming over a grid of parameters; slow";
  }
  SmoothingResult Smooth(const WalkProblem& problem, const MethodOptions& options,
                         SmoothingMonitor& monitor) const override {
    const OptimizerOptions optimizer = options.Get(OptimizerGroup()).options;
    monitor.LimitTo(optimizer.effort, optimizer.deadline);
    ReferenceOptions reference{.parameters = optimizer.program.parameters};
    const bool more = reference.parameters.heights || reference.parameters.durations;
    if (more && problem.scene().rests()) {
      Methods starts = Methods::Standard();
      starts.Add(std::make_shared<CoordinateSmoother>());
      for (const char* method : {"dichotomy/uniform", "coordinate"}) {
        SmoothingMonitor within(monitor.Part(0.0, 0.0));
        reference.starts.push_back(starts.Find(method).Smooth(problem, options, within).parameters);
      }
    }
    return ReferenceSearch(problem, reference, monitor);
  }
};

}  // namespace

void AddReferenceSmoothers(Methods* methods) {
  methods->Add(std::make_shared<CoordinateSmoother>());
  methods->Add(std::make_shared<GridSmoother>());
}

}  // namespace halfstep
