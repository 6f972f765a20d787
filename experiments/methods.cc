#include "experiments/methods.h"

#include "opt/solver.h"
#include "wpg/check.h"

namespace halfstep {

namespace {

using Progress = std::function<void(double)>;

Method SolverMethod(const std::string& solver) {
  return {solver, "the program `fastest` by this solver, between two dichotomies",
          [solver](const HalfStepSequence& sequence, const FeasibilityTest& test,
                   const MethodOptions& options, const Progress& progress, std::stop_token stop) {
            OptimizerOptions optimizer = options.optimizer;
            optimizer.solver = solver;
            return OptimizeOverlaps(sequence, test, optimizer, progress, stop);
          },
          OptionGroup::kOptimizer};
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
