// What a step's quadratic program of halfstep/sqp costs, exact and as loose as the solver asks for
// it: where ten iterations from a dichotomy have led, all families but footsteps. Run:
// build/release/tests/subproblem_benchmark. Instructions: the same under valgrind
// --tool=callgrind --toggle-collect='*halfstep::opt::Solve(*'.

#include <benchmark/benchmark.h>

#include <string>

#include "experiments/config/experiment.h"
#include "opt/adapters/solver_registry.h"
#include "opt/problem/scaled_rows.h"
#include "opt/solvers/elastic_subproblem.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/overlap_optimizer.h"
#include "smoothing/methods/search_tuning.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/places.h"
#include "tests/smoothing/smoothed.h"

namespace halfstep {
namespace {

constexpr int kIterations = 10;
constexpr double kRegion = 0.1;  // of the variables' widths: the first trust region
constexpr double kPenalty = 2.0;

// The gap is so many thousandths of what the step saves.
void Subproblem(benchmark::State& state, const char* config) {
  const Experiment e =
      Prepare(LoadConfig(InSources("experiments/configs/") + std::string(config), {}));
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, {});
  const SmoothingResult start =
      Smoothed(Dichotomy, ProblemOf(e.sequence, test), {.tolerance = 0.05});
  OptimizerOptions options;
  options.program.parameters = EveryFamily();
  options.program.parameters.footsteps = false;
  const auto solver = opt::MakeSolver("halfstep/sqp");
  options.program.watch.row_per_instant = true;
  options.program.watch.sharpness = options.tuning.sharpness;
  options.program.watch.instants = options.tuning.instants;
  const OverlapProgram program(e.sequence, evaluator, options.program,
                               DurationOf(start.parameters));
  const opt::Problem problem = program.MakeProblem();
  opt::SolverOptions first;
  first.max_iterations = kIterations;
  first.optimality_tolerance = 1e-4;
  first.solver_options = solver->traits().nearly_linear;
  const Eigen::VectorXd x =
      solver->Solve(problem, program.ToVariables(start.parameters), first).final_x;
  const std::vector<double> jacobian = problem.Jacobian(x);
  const opt::ScaledRows rows(problem, jacobian);
  const Eigen::SparseMatrix<double> A = rows.Jacobian(jacobian);
  const Eigen::VectorXd region = kRegion * (problem.upper() - problem.lower());
  const opt::LimitedMemoryHessian flat(0);
  const opt::ElasticSubproblem subproblem{.hessian = flat,
                                          .g = problem.Gradient(x),
                                          .A = A,
                                          .c = rows.Values(problem.Constraints(x)),
                                          .lower = (problem.lower() - x).cwiseMax(-region),
                                          .upper = (problem.upper() - x).cwiseMin(region),
                                          .penalty = Eigen::VectorXd::Constant(A.rows(), kPenalty),
                                          .gap = 1e-3 * static_cast<double>(state.range(0))};
  opt::ElasticStep step{};
  for (auto _ : state) step = opt::Solve(subproblem);
  state.counters["variables"] = static_cast<double>(A.cols());
  state.counters["rows"] = static_cast<double>(A.rows());
  state.counters["algebra"] = static_cast<double>(step.linear_algebra);
}
BENCHMARK_CAPTURE(Subproblem, bar_8cm, "bar_8cm.yaml")
    ->Arg(0)
    ->Arg(30)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Subproblem, fig4, "fig4_raw_sequence.yaml")
    ->Arg(0)
    ->Arg(30)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace halfstep
