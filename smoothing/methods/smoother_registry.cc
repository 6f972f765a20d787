#include "smoothing/methods/smoother_registry.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <utility>

#include "opt/adapters/solver_registry.h"
#include "smoothing/methods/given_walk.h"
#include "smoothing/methods/lipm_bound.h"
#include "smoothing/methods/uniform_scan.h"
#include "wpg/check.h"

namespace halfstep {
namespace {

using Search =
    std::function<SmoothingResult(const WalkProblem&, const SmootherOptions&, SmoothingMonitor&)>;

// A smoother that is a function.
class NamedSmoother : public Smoother {
 public:
  NamedSmoother(std::string name, std::string meaning, OptionGroup group, Search search)
      : name_(std::move(name)),
        meaning_(std::move(meaning)),
        group_(group),
        search_(std::move(search)) {}

  std::string name() const override { return name_; }
  std::string meaning() const override { return meaning_; }
  OptionGroup options() const override { return group_; }
  SmoothingResult Smooth(const WalkProblem& problem, const SmootherOptions& options,
                         SmoothingMonitor& monitor) const override {
    return search_(problem, options, monitor);
  }

 private:
  std::string name_, meaning_;
  OptionGroup group_;
  Search search_;
};

// The program by a solver, or a Pareto curve of programs.
Search BySolver(const std::string& solver) {
  return [solver](const WalkProblem& problem, const SmootherOptions& options,
                  SmoothingMonitor& monitor) {
    OptimizerOptions optimizer = options.optimizer;
    optimizer.solver = solver;
    if (options.pareto) return ParetoCurve(problem, optimizer, *options.pareto, monitor);
    return OptimizeOverlaps(problem, optimizer, monitor);
  };
}

// The dichotomy with something changed.
Search DichotomyWith(const std::function<void(DichotomyOptions*)>& change) {
  return [change](const WalkProblem& problem, const SmootherOptions& options,
                  SmoothingMonitor& monitor) {
    DichotomyOptions dichotomy = options.dichotomy;
    change(&dichotomy);
    return Dichotomy(problem, dichotomy, monitor);
  };
}

// What other methods are compared with. The families are those of smoothing.optimizer; `uniform`
// takes heights and durations both when it names neither. So is the deadline.
SmoothingResult Uniform(const WalkProblem& problem, const SmootherOptions& options,
                        SmoothingMonitor& monitor) {
  monitor.LimitTo(options.optimizer.deadline);
  const ParameterChoice& choice = options.optimizer.program.parameters;
  const bool neither = !choice.heights && !choice.durations;
  return UniformScan(problem,
                     {.heights = choice.heights || neither,
                      .durations = choice.durations || neither,
                      .fine = options.dichotomy.tolerance},
                     monitor);
}

SmoothingResult ByWindows(const WalkProblem& problem, const SmootherOptions& options,
                          SmoothingMonitor& monitor) {
  HorizonOptions horizon = options.horizon;
  horizon.program = options.optimizer.program;
  // A curve is made of programs that belong to the whole walk, as `safest` does.
  if (options.pareto) horizon.program.kind = ProgramKind::kSafest;
  horizon.deadline = options.optimizer.deadline;
  horizon.tolerance = options.optimizer.tolerance;
  return Horizon(problem, horizon, monitor);
}

std::shared_ptr<const Smoother> SolverMethod(const std::string& solver) {
  return std::make_shared<NamedSmoother>(
      solver, "smoothing.optimizer.program by this solver, from the dichotomy's result",
      OptionGroup::kOptimizer, BySolver(solver));
}

using SmootherList = std::vector<std::shared_ptr<const Smoother>>;

SmootherList MakeSmoothers() {
  using enum OptionGroup;
  SmootherList all;
  const auto add = [&all](const std::string& name, const std::string& meaning, OptionGroup group,
                          Search search) {
    all.push_back(std::make_shared<NamedSmoother>(name, meaning, group, std::move(search)));
  };
  add("dichotomy", "bisect each overlap in turn, with the options of smoothing.dichotomy",
      kDichotomy, DichotomyWith([](DichotomyOptions*) {}));
  add("dichotomy/published", "the same as published: 0.05 s, one pass, caps 0.8 and 0.76", kNone,
      DichotomyWith([](DichotomyOptions* d) {
        *d = {.tolerance = 0.05, .up_down_cap = 0.8, .down_up_cap = 0.76};
      }));
  add("dichotomy/right_to_left", "dichotomy from the last junction to the first", kDichotomy,
      DichotomyWith([](DichotomyOptions* d) { d->order = DichotomyOptions::Order::kRightToLeft; }));
  add("dichotomy/three_passes", "dichotomy three times over, onwards each time", kDichotomy,
      DichotomyWith([](DichotomyOptions* d) { d->passes = 3; }));
  add("dichotomy/uniform", "dichotomy at the best uniform T and height of a grid", kOptimizer,
      Uniform);
  add("reference/lipm", "a lower bound on every walk of a LIPM on the footsteps; finds no walk",
      kNone, [](const WalkProblem& problem, const SmootherOptions&, SmoothingMonitor& monitor) {
        return TellLipmBound(problem, monitor);
      });
  for (const std::string& solver : opt::SolverNames()) {
    if (opt::MakeSolver(solver)->available()) all.push_back(SolverMethod(solver));
  }
  add("halfstep/horizon",
      "the program of halfstep/sqp in short windows along the walk, for walks of any length",
      kHorizon, ByWindows);
  add("given", "no search: the walk of smoothing.given, checked and certified like any other",
      kGiven,
      [](const WalkProblem& problem, const SmootherOptions& options, SmoothingMonitor& monitor) {
        return TakeGivenWalk(problem, options.given, monitor);
      });
  return all;
}

auto FindByName(SmootherList* list, const std::string& name) {
  return std::ranges::find_if(*list, [&](const auto& known) { return known->name() == name; });
}

struct SmootherRegistry {
  SmootherList all = MakeSmoothers();
  size_t built_in = all.size();
};

SmootherRegistry& TheSmoothers() {
  static SmootherRegistry registry;
  return registry;
}

}  // namespace

const std::vector<std::shared_ptr<const Smoother>>& Smoothers() {
  SmootherList& all = TheSmoothers().all;
  for (const std::string& solver : opt::SolverNames()) {  // one may have been registered since
    if (FindByName(&all, solver) == all.end() && opt::MakeSolver(solver)->available()) {
      all.push_back(SolverMethod(solver));
    }
  }
  return all;
}

void RegisterSmoother(std::shared_ptr<const Smoother> smoother) {
  auto& [all, built_in] = TheSmoothers();
  const auto same = FindByName(&all, smoother->name());
  if (same < all.begin() + static_cast<std::ptrdiff_t>(built_in)) {
    throw std::invalid_argument("method `" + smoother->name() + "` is built in");
  }
  if (same != all.end()) {
    *same = std::move(smoother);
  } else {
    all.push_back(std::move(smoother));
  }
}

std::vector<std::string> SmootherNames() {
  std::vector<std::string> names;
  for (const auto& smoother : Smoothers()) names.push_back(smoother->name());
  return names;
}

const Smoother& FindSmoother(const std::string& name) {
  for (const auto& smoother : Smoothers()) {
    if (smoother->name() == name) return *smoother;
  }
  HALFSTEP_CHECK(false, "no method '" << name << "'");
  return *Smoothers().front();
}

}  // namespace halfstep
