#pragma once

#include <functional>
#include <stop_token>
#include <string>

#include "smoothing/feasibility_test.h"
#include "smoothing/overlap_program.h"
#include "smoothing/smoothing_result.h"

namespace halfstep {

struct OptimizerOptions {
  std::string solver = "ipopt";  ///< opt::SolverNames
  ProgramOptions program;
  int max_iterations = 100;  ///< of the solver
  double deadline = 30.0;    ///< of the solver [s]
  double tolerance = 0.001;  ///< of the dichotomies before and after [s]
};

/// Smooths a whole sequence by a nonlinear program. Whatever the solver does, what is returned was
/// found feasible by `test`:
///   1. the planned motion is the first incumbent, the dichotomy's result the next;
///   2. the solver starts from the dichotomy's result; each of its iterates is a candidate for the
///      FeasiblePath;
///   3. polish: dichotomy passes from the incumbent over all junctions.
/// So no method ends worse than the dichotomy. Statuses as for Dichotomy.
SmoothingResult OptimizeOverlaps(const HalfStepSequence& sequence, const FeasibilityTest& test,
                                 const OptimizerOptions& options,
                                 const std::function<void(double)>& progress = {},
                                 std::stop_token stop = {});

}  // namespace halfstep
