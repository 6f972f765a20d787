#include "smoothing/overlap_optimizer.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "opt/solver.h"
#include "smoothing/dichotomy.h"
#include "smoothing/feasible_path.h"

namespace halfstep {

SmoothingResult OptimizeOverlaps(const HalfStepSequence& sequence, const FeasibilityTest& test,
                                 const OptimizerOptions& options,
                                 const std::function<void(double)>& progress,
                                 std::stop_token stop) {
  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed = [begin] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  const auto part = [&progress](double from, double to) {
    return [&progress, from, to](double done) {
      if (progress) progress(from + (to - from) * done);
    };
  };
  DichotomyOptions dichotomy{.tolerance = options.tolerance};
  SmoothingResult result = Dichotomy(sequence, test, dichotomy, part(0.0, 0.2), stop);
  if (result.status != SmoothingStatus::kFinished) return result;

  const OverlapProgram program(sequence, test.evaluator(), options.program);
  FeasiblePath path(sequence, test, result.parameters, DurationOf);
  const opt::Problem problem = program.MakeProblem();
  opt::SolverOptions solver_options;
  solver_options.max_iterations = options.max_iterations;
  solver_options.deadline = options.deadline;
  solver_options.stop = stop;
  int seen = 0;
  solver_options.on_iterate = [&](const opt::Iterate& iterate) {
    const double lambda = path.Toward(program.ToParameters(iterate.x));
    SmoothingIterate record{.wall = elapsed(),
                            .evaluations = result.instants + path.scratch().instants,
                            .candidate_duration = program.Duration(iterate.x),
                            .accepted = lambda > 0.0,
                            .lambda = lambda,
                            .incumbent_duration = path.cost()};
    if (iterate.violation > 0.0) record.candidate_slack = -iterate.violation;
    result.iterates.push_back(record);
    part(0.2, 0.9)(std::min(1.0, ++seen / static_cast<double>(options.max_iterations)));
    return true;
  };
  const opt::Solution solution =
      opt::MakeSolver(options.solver)
          ->Solve(problem, program.ToVariables(result.parameters), solver_options);
  if (solution.x.size() == program.num_variables()) path.Toward(program.ToParameters(solution.x));

  dichotomy.start = path.incumbent();
  SmoothingResult polished = Dichotomy(sequence, test, dichotomy, part(0.9, 1.0), stop);
  for (SmoothingIterate& iterate : polished.iterates) {
    iterate.wall += elapsed();
    result.iterates.push_back(iterate);
  }
  polished.iterates = std::move(result.iterates);
  polished.time_to_first_improvement = result.time_to_first_improvement;
  polished.instants += result.instants + path.scratch().instants;
  polished.collision_queries += result.collision_queries + path.scratch().bodies.queries;
  polished.wall = elapsed();
  polished.message =
      options.solver + " ended " + opt::ToString(solution.status) + ": " + solution.message;
  return polished;
}

}  // namespace halfstep
