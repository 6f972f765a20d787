#include <algorithm>
#include <functional>
#include <stdexcept>
#include <utility>

#include "opt/adapters/solver_registry.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/given_walk.h"
#include "smoothing/methods/horizon.h"
#include "smoothing/methods/lipm_bound.h"
#include "smoothing/methods/methods.h"
#include "smoothing/methods/solver_method_options.h"
#include "smoothing/methods/uniform_scan.h"

namespace halfstep {
namespace {

using Groups = std::vector<DeclaredGroup>;
using Search =
    std::function<SmoothingResult(const WalkProblem&, const MethodOptions&, SmoothingMonitor&)>;
using Request = std::function<void(Fields&, const MethodOptions&)>;

// A smoother that is a function. Without a request: the one that every smoother makes.
class NamedSmoother : public Smoother {
 public:
  NamedSmoother(std::string name, std::string meaning, Groups groups, Search search,
                Request request)
      : name_(std::move(name)),
        meaning_(std::move(meaning)),
        groups_(std::move(groups)),
        search_(std::move(search)),
        request_(std::move(request)) {}

  std::string name() const override { return name_; }
  std::string meaning() const override { return meaning_; }
  Groups groups() const override { return groups_; }
  void DeclareRequest(Fields& fields, MethodOptions options) const override {
    if (!request_) return Smoother::DeclareRequest(fields, std::move(options));
    request_(fields, options);
  }
  SmoothingResult Smooth(const WalkProblem& problem, const MethodOptions& options,
                         SmoothingMonitor& monitor) const override {
    return search_(problem, options, monitor);
  }

 private:
  std::string name_, meaning_;
  Groups groups_;
  Search search_;
  Request request_;
};

constexpr const char* kPareto = "pareto";  // the program that is a ParetoCurve

// The program by a solver, or a Pareto curve of programs.
Search BySolver(const std::string& solver, const std::shared_ptr<const opt::Solver>& own = {}) {
  return [solver, own](const WalkProblem& problem, const MethodOptions& options,
                       SmoothingMonitor& monitor) {
    SolverMethodOptions all = options.Get(OptimizerGroup());
    all.options.solver = solver;
    all.options.own_solver = own;
    if (all.program == kPareto) return ParetoCurve(problem, all.options, all.pareto, monitor);
    return OptimizeOverlaps(problem, all.options, monitor);
  };
}

// The dichotomy with something changed.
Search DichotomyWith(const std::function<void(DichotomyOptions*)>& change) {
  return [change](const WalkProblem& problem, const MethodOptions& options,
                  SmoothingMonitor& monitor) {
    DichotomyOptions dichotomy = options.Get(DichotomyGroup());
    change(&dichotomy);
    return Dichotomy(problem, dichotomy, monitor);
  };
}

// What other methods are compared with. The families are those of smoothing.optimizer; `uniform`
// takes heights and durations both when it names neither. So is the effort.
SmoothingResult Uniform(const WalkProblem& problem, const MethodOptions& options,
                        SmoothingMonitor& monitor) {
  const OptimizerOptions optimizer = options.Get(OptimizerGroup()).options;
  monitor.LimitTo(optimizer.effort, optimizer.deadline);
  const ParameterChoice& choice = optimizer.program.parameters;
  const bool neither = !choice.heights && !choice.durations;
  return UniformScan(problem,
                     {.heights = choice.heights || neither,
                      .durations = choice.durations || neither,
                      .fine = options.Get(DichotomyGroup()).tolerance},
                     monitor);
}

SmoothingResult ByWindows(const WalkProblem& problem, const MethodOptions& options,
                          SmoothingMonitor& monitor) {
  const HorizonOptions horizon = options.Get(HorizonGroup());
  SolverMethodOptions optimizer = options.Get(OptimizerGroup());
  OptimizerOptions& o = optimizer.options;
  // A curve is made of programs that belong to the whole walk, as `safest` does.
  if (optimizer.program == kPareto || o.program.kind == ProgramKind::kSafest) {
    if (!monitor.BeginFeasibly(problem, problem.Start())) return monitor.Refusal();
    return monitor.Finish(opt::Ending::kInvalidInput,
                          "halfstep/horizon has no program `safest` or `pareto` (valid: fastest, "
                          "smooth); the walk is the planned one");
  }
  o.solver = "halfstep/sqp";
  o.own_solver.reset();
  o.only = SearchStage{.window = horizon.window,
                       .step = horizon.step,
                       .passes = horizon.passes,
                       .rounds = o.tuning.window_rounds};
  return OptimizeOverlaps(problem, o, monitor);
}

void RequestSolver(Fields& fields, const MethodOptions& options) {
  DeclareSolverRequest(fields, options.Get(OptimizerGroup()));
}

void RequestHorizon(Fields& fields, const MethodOptions& options) {
  HorizonOptions horizon = options.Get(HorizonGroup());
  SolverMethodOptions optimizer = options.Get(OptimizerGroup());
  std::string variables = VariableNames(optimizer.options.program.parameters);
  fields.Text("variables", &variables, {});
  fields.Text("objective", &optimizer.program, {});
  fields.Integer("window", &horizon.window, {});
  fields.Integer("step", &horizon.step, {});
  fields.Integer("passes", &horizon.passes, {});
  fields.Number("effort", &optimizer.options.effort, {});
  fields.Number("tolerance_s", &optimizer.options.tolerance, {});
}

void RequestGiven(Fields& fields, const MethodOptions&) {
  std::string variables = VariableNames(EveryFamily());
  fields.Text("variables", &variables, {});
}

// When a solver suits, for `halfstep list methods`.
std::string SolverMeaning(const std::string& solver) {
  if (solver == "halfstep/sqp")
    return "our SQP: the shortest walks of the shipped configs; take it first";
  if (solver == "halfstep/barrier")
    return "our barrier: stays inside the limits, walks a little longer";
  if (solver == "ipopt") return "Ipopt, interior point: a second opinion on halfstep/sqp";
  if (solver == "ceres/auglag") return "Ceres, augmented Lagrangian: to compare solvers";
  if (solver == "nlopt/slsqp") return "NLopt's dense SQP: a second opinion, on short walks";
  if (solver == "nlopt/bobyqa")
    return "NLopt, within bounds alone: refuses programs with rows, as these";
  if (solver == "nlopt/cobyla")
    return "NLopt, without derivatives: for costs of one's own, few variables";
  if (solver == "nlopt/isres")
    return "NLopt, global and random: for few variables, with much effort";
  if (solver.starts_with("nlopt/")) return "NLopt: to compare solvers";
  return "the program by this solver of one's own";
}

std::shared_ptr<const Smoother> SolverMethod(const std::string& solver,
                                             const std::shared_ptr<const opt::Solver>& own = {}) {
  return std::make_shared<NamedSmoother>(solver, SolverMeaning(solver), Groups{OptimizerGroup()},
                                         BySolver(solver, own), RequestSolver);
}

}  // namespace

Methods Methods::Standard() {
  std::vector<std::shared_ptr<const Smoother>> all;
  const auto add = [&all](const std::string& name, const std::string& meaning, Groups groups,
                          Search search, Request request = {}) {
    all.push_back(std::make_shared<NamedSmoother>(name, meaning, std::move(groups),
                                                  std::move(search), std::move(request)));
  };
  const Groups none, dichotomy = {DichotomyGroup()}, optimizer = {OptimizerGroup()};
  add("dichotomy", "each overlap bisected in turn: quick, to compare others with", dichotomy,
      DichotomyWith([](DichotomyOptions*) {}));
  add("dichotomy/published",
      "the same as in the source paper (0.05 s, one pass, caps 0.8 and 0.76): to reproduce it",
      none, DichotomyWith([](DichotomyOptions* d) {
        *d = {.tolerance = 0.05, .up_down_cap = 0.8, .down_up_cap = 0.76};
      }));
  add("dichotomy/right_to_left",
      "dichotomy from the last junction to the first: to see how much the order matters", dichotomy,
      DichotomyWith([](DichotomyOptions* d) { d->order = DichotomyOptions::Order::kRightToLeft; }));
  add("dichotomy/three_passes",
      "dichotomy three times over: a little shorter, for three times the work", dichotomy,
      DichotomyWith([](DichotomyOptions* d) { d->passes = 3; }));
  add("dichotomy/uniform",
      "dichotomy at the best T and height that all half-steps share: how far two numbers lead",
      optimizer, Uniform, RequestSolver);
  add("reference/lipm",
      "no walk, but a lower bound on all of a LIPM on the footsteps: how much is left to gain",
      none, [](const WalkProblem& problem, const MethodOptions&, SmoothingMonitor& monitor) {
        return TellLipmBound(problem, monitor);
      });
  for (const std::string& solver : opt::SolverNames()) {
    if (!opt::MakeSolver(solver)->available()) continue;
    all.push_back(SolverMethod(solver));
  }
  add("halfstep/horizon",
      "halfstep/sqp in windows along the walk: for more than about 60 half-steps",
      {HorizonGroup(), OptimizerGroup()}, ByWindows, RequestHorizon);
  add(
      "given", "no search: the walk of smoothing.given is judged: for overlaps from elsewhere",
      none,
      [](const WalkProblem& problem, const MethodOptions& options, SmoothingMonitor& monitor) {
        return TakeGivenWalk(problem, options.Get(GivenWalkGroup()), monitor);
      },
      RequestGiven);
  return Methods(std::move(all));
}

void Methods::AddSolver(std::shared_ptr<const opt::Solver> solver) {
  const std::string name = solver->name();
  if (std::ranges::count(opt::SolverNames(), name) > 0) {
    throw std::invalid_argument("solver `" + name + "` is built in");
  }
  Add(SolverMethod(name, solver));
  std::erase_if(solvers_, [&](const auto& known) { return known->name() == name; });
  solvers_.push_back(std::move(solver));
}

}  // namespace halfstep
