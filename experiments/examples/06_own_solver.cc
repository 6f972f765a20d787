// 06: a solver of one's own. What it proposes is certified before it counts.
#include <halfstep/experiments/halfstep.h>

#include <cstdio>

using namespace halfstep;

// Steps against the slope of cost + 20 · Σ max(0, −row)², back into the box after each.
Eigen::VectorXd Descend(opt::SolveMonitor& monitor, const Eigen::VectorXd& x0) {
  const opt::Problem& problem = monitor.problem();
  Eigen::VectorXd x = x0, rows;
  for (int k = 0; k < 40 && monitor.Constraints(x, &rows); ++k) {
    const Eigen::VectorXd missing = (problem.constraint_lower() - rows).cwiseMax(0.0);
    const Eigen::VectorXd slope =
        problem.Gradient(x) - 40.0 * problem.DenseJacobian(x).transpose() * missing;
    x -= 0.05 / (1 + 0.1 * k) * slope / std::max(1e-9, slope.cwiseAbs().maxCoeff());
    x = x.cwiseMax(problem.lower()).cwiseMin(problem.upper());
  }
  return x;
}

int main(int argc, char** argv) {
  Methods methods = Methods::Standard();
  methods.AddSolver(opt::MakeFunctionSolver("mine/descent", Descend));
  if (argc > 1) return RunExperiment(argc, argv, {methods});  // configs may name mine/descent now
  const ExperimentConfig config =
      LoadConfig((DataFolder() / "configs/bar_8cm.yaml").string(),
                 {{"smoothing.profile", "limit"},  // where also a simple solver gains
                  {"smoothing.optimizer.durations", "true"},
                  {"smoothing.optimizer.rounds", "2"}});
  const WalkProblem problem = ProblemOf(Prepare(config));
  for (const char* method : {"dichotomy", "mine/descent"}) {
    SmoothingMonitor monitor;
    const SmoothingResult result =
        methods.Find(method).Smooth(problem, config.smoothing.options, monitor);
    std::printf("%-13s %.3f s\n", method, result.cost);
  }
}
