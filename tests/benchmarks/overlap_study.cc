// What the overlap programs find, and what they cost. Prints the tables of
// notebooks-data/measurements.md, "What the programs find". Not a test.
// Run: overlap_study table SCENARIO EFFORT METHOD… (CSV: all variables and programs)
//      overlap_study table SCENARIO:VARIABLES:PROGRAM EFFORT METHOD…
//      overlap_study grow METHOD N…                 (a straight walk of N half-steps)
//      overlap_study reach METHOD[:ITERATIONS] EFFORT SCENE…   (a config, bars:N or FILE.yaml:N)
//      overlap_study solve SCENE METHOD VARIABLES KIND [EFFORT]
//      overlap_study rows CONFIG
//      overlap_study threads METHOD THREADS SCENE…   (the same again with one thread)

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "opt/adapters/solver_registry.h"
#include "opt/problem/problem_derivatives.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/methods.h"
#include "smoothing/methods/overlap_optimizer.h"
#include "smoothing/methods/solver_method_options.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/places.h"
#include "tests/smoothing/smoothed.h"

namespace halfstep {
namespace {

double Now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Experiment Load(const std::string& name) {
  return Prepare(LoadConfig(InSources("experiments/configs/") + name + ".yaml", {}));
}

// Processor time of the calling thread [s].
double OwnProcessor() {
  std::timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// The four steps of bar_8cm again and again, n half-steps, each time 0.454 m further, over a bar of
// their own.
Experiment Bars(int n) {
  Experiment e = Load("bar_8cm");
  std::vector<FootstepConfig> footsteps;
  const Obstacle bar = e.scene.obstacles.front();
  Scene scene = e.scene;
  scene.obstacles.clear();
  for (int i = 0; i < n / 2; ++i) {
    FootstepConfig step = e.config.footsteps[static_cast<size_t>(i % 4)];
    step.X_WF.x += 0.454 * (i / 4);
    footsteps.push_back(step);
    if (i % 4 == 0) {
      Obstacle another = bar;
      another.name += std::to_string(i / 4);
      another.X_WO.translation().x() += 0.454 * (i / 4);
      scene.obstacles.push_back(another);
    }
  }
  e.config.footsteps = footsteps;
  e = Prepare(e.config);
  e.scene = scene;
  return e;
}

// A config's name, bars:N, or FILE.yaml:N: the first N half-steps of a config with footsteps, such
// as that in the folder of a planned run.
Experiment LoadScene(const std::string& what) {
  const size_t colon = what.find(':');
  if (colon == std::string::npos) return Load(what);
  const int n = std::atoi(what.c_str() + colon + 1);
  if (what.substr(0, colon) == "bars") return Bars(n);
  ExperimentConfig config = LoadConfig(what.substr(0, colon), {});
  config.footsteps.resize(std::min(config.footsteps.size(), static_cast<size_t>(n / 2)));
  return Prepare(config);
}

ProgramKind KindOf(const std::string& name) {
  for (ProgramKind kind : {ProgramKind::kFastest, ProgramKind::kSmooth, ProgramKind::kSafest}) {
    if (name == Name(kind)) return kind;
  }
  std::fprintf(stderr, "no program %s\n", name.c_str());
  std::exit(2);
}

void Solve(const std::string& config, const std::string& method, const std::string& variables,
           const std::string& kind, double effort) {
  const Experiment e = LoadScene(config);
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, {});
  OptimizerOptions options;
  options.solver = method;
  options.program.kind = KindOf(kind);
  options.program.parameters.heights = variables.find('h') != std::string::npos;
  options.program.parameters.durations = variables.find('t') != std::string::npos;
  options.effort = effort;
  const double begin = Now();
  const SmoothingResult result = Smoothed(OptimizeOverlaps, ProblemOf(e.sequence, test), options);
  for (const SmoothingIterate& i : result.iterates) {
    if (i.incumbent_cost == 0.0) continue;
    std::printf("  %7.3f s  D %7.4f  slack %9.5f  lambda %.3f  incumbent D %.4f  cost %.4f\n",
                i.wall, i.candidate_duration, i.candidate_worst_margin.value_or(0.0), i.lambda,
                i.incumbent_duration, i.incumbent_cost);
  }
  std::printf("%s %s %s %s: D %.4f cost %.4f, %.2f s, raw infeasible %ld, %s\n", config.c_str(),
              method.c_str(), variables.c_str(), kind.c_str(), DurationOf(result.parameters),
              result.cost, Now() - begin, result.raw_infeasible, result.message.c_str());
}

// First wall time at which the incumbent was within `gap` of `best`; −1: never.
double TimeToWithin(const SmoothingResult& result, double best, double gap) {
  for (const SmoothingIterate& i : result.iterates) {
    if (i.incumbent_duration <= best * (1.0 + gap)) return i.wall;
  }
  return -1.0;
}

struct Case {
  std::string method;
  SmoothingResult result;
  long accepted = 0, refuted = 0;  // incumbents before the result, and those not certified again
  bool certified = false;
};

Case SolveCase(const Experiment& e, const MarginEvaluator& evaluator, const std::string& method,
               const std::string& variables, const std::string& kind, double effort) {
  const CertifiedFeasibility test(evaluator, {});
  Case done{.method = method, .result = {}};
  std::vector<HomotopyParameters> incumbents;
  MethodOptions options;
  OptimizerOptions& optimizer = options.Edit(OptimizerGroup()).options;
  optimizer.program.kind = KindOf(kind);
  optimizer.program.parameters = {};
  optimizer.program.parameters.heights = variables.find('h') != std::string::npos;
  optimizer.program.parameters.durations = variables.find('t') != std::string::npos;
  optimizer.effort = effort;
  SmoothingMonitor monitor(
      {.on_incumbent = [&](const HomotopyParameters& p) { incumbents.push_back(p); }});
  done.result =
      Methods::Standard().Find(method).Smooth(ProblemOf(e.sequence, test), options, monitor);
  incumbents.push_back(done.result.parameters);
  for (const HomotopyParameters& p : incumbents) {
    const SuperposedWalk walk(e.sequence, p);
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    done.certified =
        test.Check(walk, {0.0, walk.duration()}, &scratch).verdict == Verdict::kFeasible;
    done.refuted += !done.certified;
  }
  done.accepted = static_cast<long>(incumbents.size()) - 1;
  return done;
}

void Table(const std::string& what, double effort, const std::vector<std::string>& methods) {
  const std::string config = what.substr(0, what.find(':'));
  const std::string only = what.substr(config.size());
  std::printf(
      "scenario,variables,program,method,status,certified,duration_s,cost,gap_to_best,"
      "instants,candidates,raw_infeasible,raw_end_feasible,incumbents,incumbents_refuted,"
      "wall_s,to_5_percent_s,to_1_percent_s\n");
  const Experiment e = Load(config);
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  for (const std::string variables : {"o", "oh", "oht"}) {
    for (const std::string kind : {"fastest", "smooth", "safest"}) {
      if (!only.empty() && only != ":" + variables + ":" + kind) continue;
      std::vector<Case> cases;
      double best = 1e9, shortest = 1e9;
      for (const std::string& method : methods) {
        const std::vector<std::string> solvers = opt::SolverNames();
        const bool solver = std::find(solvers.begin(), solvers.end(), method) != solvers.end();
        if (kind != "fastest" && !solver) continue;
        cases.push_back(SolveCase(e, evaluator, method, variables, kind, effort));
        best = std::min(best, cases.back().result.cost);
        shortest = std::min(shortest, DurationOf(cases.back().result.parameters));
      }
      for (const Case& c : cases) {
        const SmoothingResult& r = c.result;
        const double gap =
            kind == "safest" ? r.cost - best : r.cost / best - 1.0;  // of a slack: no ratio
        std::printf("%s,%s,%s,%s,%s,%s,%.4f,%.4f,%.5f,%ld,%zu,%ld,%s,%ld,%ld,%.3f", config.c_str(),
                    variables.c_str(), kind.c_str(), c.method.c_str(),
                    std::string(Name(r.ending)).c_str(), c.certified ? "true" : "false",
                    DurationOf(r.parameters), r.cost, gap, r.work.evaluated(), r.iterates.size(),
                    r.raw_infeasible, r.raw_end_feasible ? "true" : "false", c.accepted, c.refuted,
                    r.wall);
        if (kind == "fastest") {
          std::printf(",%.3f,%.3f\n", TimeToWithin(r, shortest, 0.05),
                      TimeToWithin(r, shortest, 0.01));
        } else {
          std::printf(",,\n");
        }
        std::fflush(stdout);
      }
    }
  }
}

// When a method's incumbent is within 5 % and 1 % of what it ends with, all variables free.
void Reach(const std::string& what, const std::string& method, double effort) {
  const Experiment e = LoadScene(what);
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, {});
  OptimizerOptions options;
  options.solver = method.substr(0, method.find(':'));
  if (options.solver != method)
    options.max_iterations = std::atoi(method.c_str() + options.solver.size() + 1);
  options.program.parameters.heights = options.program.parameters.durations = true;
  options.effort = effort;
  const double begin = Now();
  const double start = DurationOf(Smoothed(Dichotomy, ProblemOf(e.sequence, test), {}).parameters);
  const double dichotomy = Now() - begin;
  const double cpu = OwnProcessor();
  std::vector<std::pair<double, double>> found;  // after which processor time, D
  const auto note = [&](const HomotopyParameters& p) {
    found.emplace_back(OwnProcessor() - cpu, DurationOf(p));
  };
  const SmoothingResult r =
      Smoothed(OptimizeOverlaps, ProblemOf(e.sequence, test), options, {.on_incumbent = note});
  const double own = OwnProcessor() - cpu;
  const double end = DurationOf(r.parameters);
  found.emplace_back(own, end);
  const auto to = [&](double gap) {
    const auto within = [&](const auto& at) { return at.second <= end * (1.0 + gap); };
    return std::ranges::find_if(found, within)->first;
  };
  std::printf(
      "%-14s %-18s n %4d  dichotomy %8.4f s in %6.3f s; %8.4f s in %7.3f s (CPU %7.3f s), to 5 %% "
      "%6.3f s (CPU %6.3f s), to 1 %% %6.3f s (CPU %6.3f s); %ld instants, %zu candidates, %ld "
      "refused\n",
      what.c_str(), method.c_str(), e.sequence.size(), start, dichotomy, end, r.wall, own,
      TimeToWithin(r, end, 0.05), to(0.05), TimeToWithin(r, end, 0.01), to(0.01),
      r.work.evaluated(), r.iterates.size(), r.raw_infeasible);
}

// What an iteration costs over n half-steps.
void Grow(const std::string& method, int n) {
  const Experiment e = Bars(n);
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, {});
  OptimizerOptions options;
  options.solver = method;
  options.program.parameters.heights = options.program.parameters.durations = true;
  options.effort = 20.0;
  const double begin = Now();
  const SmoothingResult start = Smoothed(Dichotomy, ProblemOf(e.sequence, test), {});
  const double dichotomy = Now() - begin;
  const OverlapProgram program(e.sequence, evaluator, options.program, 0.0);
  const opt::Problem problem = program.MakeProblem();
  const Eigen::VectorXd x = program.ToVariables(start.parameters);
  double both = 1e9;
  for (int repeat = 0; repeat < 3; ++repeat) {
    const double at = Now();
    problem.Jacobian(x);
    both = std::min(both, Now() - at);
  }
  opt::SolverOptions solver;
  solver.max_iterations = 20;
  solver.optimality_tolerance = 1e-4;
  const opt::Solution solution = opt::MakeSolver(method)->Solve(problem, x, solver);
  std::printf("%-18s n %4d  dichotomy %.3f s (%.2f s)  Jacobian %7.2f ms  %7.2f ms an iteration",
              method.c_str(), n, DurationOf(start.parameters), dichotomy, 1e3 * both,
              1e3 * solution.wall / std::max(1, solution.iterations));
  constexpr int kWhole = 40;  // longer ones are not solved to their end
  if (n <= kWhole) {
    const SmoothingResult r = Smoothed(OptimizeOverlaps, ProblemOf(e.sequence, test), options);
    const double shortest = DurationOf(r.parameters);
    std::printf("  D %.3f, within 5%% %.2f s, 1%% %.2f s, all %.2f s, %ld instants", shortest,
                TimeToWithin(r, shortest, 0.05), TimeToWithin(r, shortest, 0.01), r.wall,
                r.work.evaluated());
  }
  std::printf("\n");
  std::fflush(stdout);
}

// Cost of the rows and of their derivatives, and whether they are right.
void Rows(const std::string& config) {
  const Experiment e = Load(config);
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, {});
  const SmoothingResult start =
      Smoothed(Dichotomy, ProblemOf(e.sequence, test), {.tolerance = 0.05});
  const int n = e.sequence.size();
  for (ProgramKind kind : {ProgramKind::kFastest, ProgramKind::kSmooth, ProgramKind::kSafest}) {
    ProgramOptions options;
    options.kind = kind;
    options.parameters.heights = options.parameters.durations = true;
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
    const opt::ProblemDerivativeReport report = opt::CheckDerivatives(problem, x, 1e-5);
    std::printf("  worst derivative: cost %.1e, rows %.1e (%s)\n", report.cost.worst_error,
                report.constraints.worst_error, report.message.c_str());
  }
}

// What a method takes with one thread and with more, by the clock and by the processor time of the
// calling thread, which tells more where others use the machine; and whether it finds the same.
void Threads(const std::string& what, const std::string& method, int threads) {
  const Experiment e = LoadScene(what);
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const CertifiedFeasibility test(evaluator, {});
  MethodOptions options;
  OptimizerOptions& optimizer = options.Edit(OptimizerGroup()).options;
  optimizer.program.parameters = {.heights = true, .durations = true};
  optimizer.rounds = 12;
  optimizer.effort = 1e4;
  std::vector<SmoothingResult> results;
  std::vector<double> proofs, own;
  for (const int n : {1, threads}) {
    const auto workers = std::make_shared<Workers>(n);
    SmoothingMonitor monitor({.workers = workers});
    const double started = OwnProcessor();
    results.push_back(
        Methods::Standard().Find(method).Smooth(ProblemOf(e.sequence, test), options, monitor));
    own.push_back(OwnProcessor() - started);
    const SuperposedWalk walk(e.sequence, results.back().parameters);
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    scratch.workers = workers.get();
    const double begin = Now();
    test.Check(walk, {0.0, walk.duration()}, &scratch);
    proofs.push_back(Now() - begin);
  }
  const bool same = results[0].parameters == results[1].parameters &&
                    results[0].work == results[1].work &&
                    results[0].iterates.size() == results[1].iterates.size() &&
                    results[0].collision_queries == results[1].collision_queries;
  std::printf("%-10s %-16s n %4d  D %.6f, %s;", what.c_str(), method.c_str(), e.sequence.size(),
              DurationOf(results[0].parameters), same ? "the same" : "NOT the same");
  std::printf(" 1 and %d threads: clock %.2f, %.2f s: %.2f; own %.2f, %.2f s: %.2f;", threads,
              results[0].wall, results[1].wall, results[0].wall / results[1].wall, own[0], own[1],
              own[0] / own[1]);
  std::printf(" proof of the end %.1f, %.1f ms: %.2f\n", 1e3 * proofs[0], 1e3 * proofs[1],
              proofs[0] / proofs[1]);
  std::fflush(stdout);
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
  } else if (part == "table") {
    std::vector<std::string> methods(argv + std::min(argc, 4), argv + argc);
    halfstep::Table(arg(2, "bar_8cm"), std::atof(arg(3, "3").c_str()), methods);
  } else if (part == "grow") {
    for (int i = 3; i < argc; ++i) halfstep::Grow(argv[2], std::atoi(argv[i]));
  } else if (part == "reach") {
    for (int i = 4; i < argc; ++i) halfstep::Reach(argv[i], argv[2], std::atof(argv[3]));
  } else if (part == "threads") {
    for (int i = 4; i < argc; ++i) halfstep::Threads(argv[i], argv[2], std::atoi(argv[3]));
  } else if (part == "rows") {
    halfstep::Rows(arg(2, "bar_8cm"));
  } else {
    std::fprintf(stderr,
                 "usage: overlap_study solve SCENE METHOD VARIABLES KIND [EFFORT] | rows CONFIG\n"
                 "VARIABLES: o, oh, ot or oht (overlaps, heights, durations)\n");
    return 2;
  }
}
