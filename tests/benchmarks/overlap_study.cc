// What the overlap programs find, and what they cost. Prints the tables of smoothing/README.md,
// "Overlap program". Not a test.
// Run: overlap_study solve CONFIG METHOD VARIABLES KIND [DEADLINE]
//      overlap_study rows CONFIG

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "experiments/experiment.h"
#include "opt/problem_derivatives.h"
#include "smoothing/certified_feasibility.h"
#include "smoothing/dichotomy.h"
#include "smoothing/overlap_optimizer.h"

namespace halfstep {
namespace {

double Now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Experiment Load(const std::string& name) {
  return Prepare(
      LoadConfig(std::string(HALFSTEP_SOURCE_DIR) + "/experiments/configs/" + name + ".yaml", {}));
}

ProgramKind KindOf(const std::string& name) {
  for (ProgramKind kind : {ProgramKind::kFastest, ProgramKind::kSmooth, ProgramKind::kSafest}) {
    if (name == Name(kind)) return kind;
  }
  std::fprintf(stderr, "no program %s\n", name.c_str());
  std::exit(2);
}

void Solve(const std::string& config, const std::string& method, const std::string& variables,
           const std::string& kind, double deadline) {
  const Experiment e = Load(config);
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, {});
  OptimizerOptions options;
  options.solver = method;
  options.program.kind = KindOf(kind);
  options.program.heights = variables.find('h') != std::string::npos;
  options.program.durations = variables.find('t') != std::string::npos;
  options.deadline = deadline;
  const double begin = Now();
  const SmoothingResult result = OptimizeOverlaps(e.sequence, test, options);
  for (const SmoothingIterate& i : result.iterates) {
    if (i.incumbent_cost == 0.0) continue;
    std::printf("  %7.3f s  D %7.4f  slack %9.5f  lambda %.3f  incumbent D %.4f  cost %.4f\n",
                i.wall, i.candidate_duration, i.candidate_slack.value_or(0.0), i.lambda,
                i.incumbent_duration, i.incumbent_cost);
  }
  std::printf("%s %s %s %s: D %.4f cost %.4f, %.2f s, raw infeasible %ld, %s\n", config.c_str(),
              method.c_str(), variables.c_str(), kind.c_str(), DurationOf(result.parameters),
              result.cost, Now() - begin, result.raw_infeasible, result.message.c_str());
}

// Cost of the rows and of their derivatives, and whether they are right.
void Rows(const std::string& config) {
  const Experiment e = Load(config);
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, {});
  const SmoothingResult start = Dichotomy(e.sequence, test, {.tolerance = 0.05});
  const int n = e.sequence.size();
  for (ProgramKind kind : {ProgramKind::kFastest, ProgramKind::kSmooth, ProgramKind::kSafest}) {
    ProgramOptions options;
    options.kind = kind;
    options.heights = options.durations = true;
    const OverlapProgram program(e.sequence, evaluator, options, DurationOf(start.parameters));
    const opt::Problem problem = program.MakeProblem();
    Eigen::VectorXd x = program.ToVariables(start.parameters);
    for (Eigen::Index v = 0; v < program.variables().size(); ++v) {
      x[v] = problem.lower()[v] + (0.05 + 0.9 * (x[v] - problem.lower()[v]) /
                                              (problem.upper()[v] - problem.lower()[v])) *
                                      (problem.upper()[v] - problem.lower()[v]);
    }
    double value = 1e9, both = 1e9;
    for (int repeat = 0; repeat < 5; ++repeat) {
      double begin = Now();
      const Eigen::VectorXd c = problem.Constraints(x);
      value = std::min(value, Now() - begin);
      begin = Now();
      const std::vector<double> j = problem.Jacobian(x);
      both = std::min(both, Now() - begin);
    }
    std::printf("%-20s %-8s rows %.3f ms, Jacobian %.3f ms a half-step, ratio %.2f\n",
                config.c_str(), std::string(Name(kind)).c_str(), 1e3 * value / n, 1e3 * both / n,
                both / value);
    const opt::ProblemDerivativeReport report = opt::CheckDerivatives(problem, x, 1e-6);
    std::printf("  worst derivative: cost %.1e, rows %.1e (%s)\n", report.cost.worst_error,
                report.constraints.worst_error, report.message.c_str());
  }
}

}  // namespace
}  // namespace halfstep

int main(int argc, char** argv) {
  const auto arg = [&](int i, const char* otherwise) {
    return std::string(argc > i ? argv[i] : otherwise);
  };
  const std::string part = arg(1, "");
  if (part == "solve") {
    halfstep::Solve(arg(2, "bar_8cm"), arg(3, "ipopt"), arg(4, "oht"), arg(5, "fastest"),
                    std::atof(arg(6, "30").c_str()));
  } else if (part == "rows") {
    halfstep::Rows(arg(2, "bar_8cm"));
  } else {
    std::fprintf(
        stderr,
        "usage: overlap_study solve CONFIG METHOD VARIABLES KIND [DEADLINE] | rows CONFIG\n"
        "VARIABLES: o, oh, ot or oht (overlaps, heights, durations)\n");
    return 2;
  }
}
