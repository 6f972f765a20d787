#include "experiments/config/methods.h"

#include "opt/adapters/solver_registry.h"
#include "smoothing/methods/coordinate_ascent.h"
#include "smoothing/methods/grid_reference.h"
#include "smoothing/methods/uniform_scan.h"
#include "wpg/check.h"

namespace halfstep {

namespace {

using Progress = std::function<void(double)>;

Method SolverMethod(const std::string& solver) {
  return {solver, "smoothing.optimizer.program by this solver, from the dichotomy's result",
          [solver](const HalfStepSequence& sequence, const FeasibilityTest& test,
                   const MethodOptions& options, const Progress& progress, std::stop_token stop) {
            OptimizerOptions optimizer = options.optimizer;
            optimizer.solver = solver;
            if (options.pareto) {
              return ParetoCurve(sequence, test, optimizer, *options.pareto, progress, stop);
            }
            return OptimizeOverlaps(sequence, test, optimizer, progress, stop);
          },
          OptionGroup::kOptimizer};
}

// The dichotomy of smoothing.dichotomy with something changed.
Method DichotomyVariant(const std::string& name, const std::string& meaning,
                        const std::function<void(DichotomyOptions*)>& change) {
  return {name, meaning,
          [change](const HalfStepSequence& sequence, const FeasibilityTest& test,
                   const MethodOptions& options, const Progress& progress, std::stop_token stop) {
            DichotomyOptions dichotomy = options.dichotomy;
            change(&dichotomy);
            return Dichotomy(sequence, test, dichotomy, progress, stop);
          },
          OptionGroup::kDichotomy};
}

// What other methods are compared with. The families are those of smoothing.optimizer; `uniform`
// takes heights and durations both when it names neither.
SmoothingResult Uniform(const HalfStepSequence& sequence, const FeasibilityTest& test,
                        const MethodOptions& options, const Progress& progress,
                        std::stop_token stop) {
  const ProgramOptions& program = options.optimizer.program;
  const bool neither = !program.heights && !program.durations;
  const UniformScanOptions scan{.heights = program.heights || neither,
                                .durations = program.durations || neither,
                                .fine = options.dichotomy.tolerance};
  return UniformScan(sequence, test, scan, progress, std::move(stop));
}

SmoothingResult Coordinate(const HalfStepSequence& sequence, const FeasibilityTest& test,
                           const MethodOptions& options, const Progress& progress,
                           std::stop_token stop) {
  const ProgramOptions& program = options.optimizer.program;
  const CoordinateAscentOptions ascent{.heights = program.heights,
                                       .durations = program.durations,
                                       .least_height_scale = program.least_height_scale,
                                       .least_duration = program.least_duration,
                                       .tolerance = options.optimizer.tolerance};
  return CoordinateAscent(sequence, test, ascent, progress, std::move(stop));
}

SmoothingResult Reference(const HalfStepSequence& sequence, const FeasibilityTest& test,
                          const MethodOptions& options, const Progress& progress,
                          std::stop_token stop) {
  const ProgramOptions& program = options.optimizer.program;
  GridReferenceOptions grid{.heights = program.heights,
                            .durations = program.durations,
                            .least_height_scale = program.least_height_scale,
                            .least_duration = program.least_duration,
                            .most_duration = program.most_duration};
  if (grid.heights || grid.durations) {
    grid.starts = {Uniform(sequence, test, options, {}, stop).parameters,
                   Coordinate(sequence, test, options, {}, stop).parameters};
  }
  return GridReference(sequence, test, grid, progress, std::move(stop));
}

std::vector<Method> MakeMethods() {
  std::vector<Method> methods = {
      {"dichotomy", "bisect each overlap in turn, with the options of smoothing.dichotomy",
       [](const HalfStepSequence& sequence, const FeasibilityTest& test,
          const MethodOptions& options, const Progress& progress, std::stop_token stop) {
         return Dichotomy(sequence, test, options.dichotomy, progress, stop);
       },
       OptionGroup::kDichotomy},
      {"dichotomy/published", "the same as published: 0.05 s, one pass, caps 0.8 and 0.76",
       [](const HalfStepSequence& sequence, const FeasibilityTest& test, const MethodOptions&,
          const Progress& progress, std::stop_token stop) {
         const DichotomyOptions published{
             .tolerance = 0.05, .up_down_cap = 0.8, .down_up_cap = 0.76};
         return Dichotomy(sequence, test, published, progress, stop);
       }},
      DichotomyVariant(
          "dichotomy/right_to_left", "dichotomy from the last junction to the first",
          [](DichotomyOptions* d) { d->order = DichotomyOptions::Order::kRightToLeft; }),
      DichotomyVariant("dichotomy/three_passes", "dichotomy three times over, onwards each time",
                       [](DichotomyOptions* d) { d->passes = 3; }),
      {"dichotomy/uniform", "dichotomy at the best uniform T and height of a grid", Uniform,
       OptionGroup::kOptimizer},
      {"coordinate", "passes over overlaps, heights and durations, each bisected in turn",
       Coordinate, OptionGroup::kOptimizer},
      {"reference", "dynamic programming over a grid of parameters; slow", Reference,
       OptionGroup::kOptimizer},
  };
  for (const std::string& solver : opt::SolverNames()) {
    if (opt::MakeSolver(solver)->available()) methods.push_back(SolverMethod(solver));
  }
  return methods;
}

}  // namespace

const std::vector<Method>& Methods() {
  static const std::vector<Method> methods = MakeMethods();
  return methods;
}

std::vector<std::string> MethodNames() {
  std::vector<std::string> names;
  for (const Method& method : Methods()) names.push_back(method.name);
  return names;
}

const Method& FindMethod(const std::string& name) {
  for (const Method& method : Methods()) {
    if (method.name == name) return method;
  }
  HALFSTEP_CHECK(false, "no method '" << name << "'");
  return Methods().front();
}

}  // namespace halfstep
