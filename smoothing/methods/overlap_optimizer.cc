#include "smoothing/methods/overlap_optimizer.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "opt/adapters/solver_registry.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/fine_dichotomies.h"
#include "smoothing/methods/overlap_prices.h"
#include "smoothing/methods/search_ending.h"
#include "smoothing/methods/search_rounds.h"
#include "smoothing/methods/whole_proof.h"
#include "smoothing/methods/whole_search.h"
#include "smoothing/methods/window_passes.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

// Of the dichotomy before a search that is to shorten the walk anyway [s]; the larger one for
// solvers that take long steps.
constexpr double kNearStart = 0.1, kFarStart = 0.5;
// Instants a half-step where each has rows of its own.
constexpr int kRowsInstants = 24;
// Windows have this part of the time that is left at most.
constexpr double kWindowsPart = 0.8;
// A search without windows follows where these end before this part of the whole time, and one in
// longer windows where the rounds over the whole end before the other.
constexpr double kAnotherPart = 0.5, kLongerPart = 0.9;
// A search that does not beat a plain dichotomy by this has found nothing [s].
constexpr double kGainedTime = 1e-9;

// What a search does beside the rounds over all that it moves.
struct Stages {
  RestartPolicy restarts;
  int window = 6;        // half-steps of the windows before them, where forms move; 0: none
  bool compares = true;  // with other searches and with fine dichotomies
};
// Before a search over more families, which goes on from what it finds.
constexpr Stages kBefore = {
    .restarts = {.poor_rounds = 2, .repeats = false}, .window = 0, .compares = false};
// Searches beside that in windows, which may come to a better walk.
constexpr Stages kWithoutWindows = {.restarts = {.repeats = false}, .window = 0, .compares = false};
constexpr Stages kInLongerWindows = {.restarts = {}, .window = 8, .compares = false};

// What to search over first: without footsteps where half-steps have forms, too; else with every
// form and footstep as planned.
ParameterChoice FewerFamilies(const ParameterChoice& choice) {
  ParameterChoice standing = choice;
  standing.footsteps = false;
  const bool has_forms = standing != WithoutForms(standing);
  return choice.footsteps && has_forms ? standing : WithoutForms(choice);
}

class Optimization {
 public:
  Optimization(const WalkProblem& problem, const OptimizerOptions& options,
               const opt::Solver& solver, const Stages& stages, SmoothingMonitor& monitor)
      : problem_(problem),
        options_(options),
        solver_(solver),
        stages_(stages),
        monitor_(monitor),
        end_{.solver = options.solver,
             .kept = options.start ? "the walk is what it started from"
                                   : "the walk is a dichotomy's"} {}

  SmoothingResult Run() {
    if (options_.deadline <= monitor_.Remaining()) end_.deadline = options_.deadline;
    monitor_.Begin(problem_, options_.start.value_or(problem_.Start()));
    DichotomyOptions dichotomy{.tolerance = StartTolerance()};
    if (options_.start) {
      dichotomy.start = options_.start;
      dichotomy.passes = 0;
    }
    Take(RunDichotomy(dichotomy, 0.0, 0.2));
    if (!monitor_.accepted() || monitor_.stopped()) {
      NoteStop();
      return monitor_.Finish(end_.Ending(), monitor_.accepted() ? end_.Sentence() : start_message_);
    }
    const ParameterChoice& all = options_.program.parameters;
    const ParameterChoice fewer = FewerFamilies(all);
    const HomotopyParameters begun = monitor_.incumbent();
    RestartPolicy restarts = stages_.restarts;
    const bool staged = Fastest() && fewer != all;
    const bool by_windows = staged && options_.windows && solver_.traits().many_rows &&
                            stages_.window > 0 && problem_.sequence().size() > stages_.window;
    if (by_windows) {
      SearchInWindows();
      restarts.planned_start = false;  // the search without windows has it
      const bool soon = monitor_.Seconds() < kAnotherPart * options_.deadline;
      if (stages_.compares && soon) SearchApart(all, begun, kWithoutWindows, 0.5);
    } else if (staged) {
      const SmoothingResult found = SearchApart(fewer, begun, kBefore, 0.5);
      if (monitor_.stopped()) return monitor_.Finish(found.ending, found.message);
    }

    const double own = DurationOf(monitor_.incumbent());
    const double limit = options_.duration_limit > 0.0 ? options_.duration_limit : own;
    OverlapProgram program(problem_.sequence(), problem_.evaluator(), options_.program, limit,
                           problem_.fixed());
    program.watched().SetWorkers(monitor_.workers());
    end_.own = SearchWhole(problem_, options_, solver_, restarts, search_from_, &program, monitor_,
                           &end_) ||
               found_apart_;
    const bool longer = problem_.sequence().size() > kInLongerWindows.window;
    const bool time_is_left = monitor_.Seconds() < kLongerPart * options_.deadline;
    if (by_windows && stages_.compares && longer && time_is_left && !monitor_.stopped()) {
      SearchApart(all, begun, kInLongerWindows, 1.0);
      end_.own = end_.own || found_apart_;
    }
    return Conclude(program);
  }

 private:
  bool Safest() const { return options_.program.kind == ProgramKind::kSafest; }
  bool Fastest() const { return options_.program.kind == ProgramKind::kFastest; }

  // Of the dichotomy before the search. `safest` and `smooth` compare with the fine one's result.
  double StartTolerance() const {
    if (!Fastest()) return options_.tolerance;
    return std::max(options_.tolerance, solver_.traits().long_steps ? kFarStart : kNearStart);
  }

  SmoothingResult RunDichotomy(const DichotomyOptions& options, double from, double to) {
    SmoothingMonitor within(monitor_.Part(from, to));
    SmoothingResult result = Dichotomy(problem_, options, within);
    monitor_.Count(result);
    return result;
  }

  // A dichotomy's walk becomes the incumbent, with its candidates.
  void Take(const SmoothingResult& dichotomy) {
    start_message_ = dichotomy.message;
    SmoothingResult& result = monitor_.result();
    result.iterates = dichotomy.iterates;
    if (dichotomy.accepted) {
      const double duration = DurationOf(dichotomy.parameters);
      monitor_.Adopt(*dichotomy.accepted, duration, duration);
    }
    result.junctions = dichotomy.junctions;
    result.time_to_first_improvement = dichotomy.time_to_first_improvement;
  }

  // Rounds in windows, from the incumbent. From a dichotomy's walk they come to better walks than
  // rounds over the whole do, and on long ones sooner.
  void SearchInWindows() {
    const double now = monitor_.Seconds();
    const WindowPassesOptions windows{
        .window = stages_.window,
        .passes = std::min(WindowPassesOptions().passes, options_.rounds),
        .program = options_.program,
        .deadline = now + kWindowsPart * (options_.deadline - now)};
    found_apart_ = SearchWindows(problem_, windows, solver_, search_from_, 0.5, monitor_, &end_);
    search_from_ = 0.5;
  }

  // The same search with other stages, from `start`, in a part of the time that is left. Over all
  // families at once the solver can miss walks that it finds when it begins at the best walk of
  // fewer.
  SmoothingResult SearchApart(const ParameterChoice& families, const HomotopyParameters& start,
                              const Stages& stages, double part) {
    OptimizerOptions options = options_;
    options.program.parameters = families;
    options.start = start;
    options.deadline = part * (options_.deadline - monitor_.Seconds());
    const double before = monitor_.cost();
    const double to = search_from_ + part * (0.9 - search_from_);
    SmoothingMonitor within(monitor_.Part(search_from_, to));
    SmoothingResult found = Optimization(problem_, options, solver_, stages, within).Run();
    search_from_ = to;
    TakeSearch(found, /*from_incumbent=*/false, monitor_);
    found_apart_ = found_apart_ || (HasOwnResult(found.ending) && monitor_.cost() < before);
    return found;
  }

  SmoothingResult Conclude(const OverlapProgram& program) {
    for (JunctionResult& junction : monitor_.result().junctions) {
      if (!Fastest() || monitor_.stopped()) junction.limited_by.reset();
    }
    if (stages_.compares && Fastest() && !monitor_.stopped()) {
      const AcceptedWalk searched = *monitor_.accepted();
      const double cost = monitor_.cost();
      const FineDichotomies fine =
          RunFineDichotomies(problem_, options_.tolerance, !options_.start, monitor_);
      TakeSearch(fine.from_incumbent, /*from_incumbent=*/true, monitor_);
      KeepWhatHolds(problem_, searched, cost, monitor_);
      if (fine.from_start) {
        const bool same = monitor_.incumbent() == problem_.Start();
        TakeSearch(*fine.from_start, same, monitor_);
        end_.own = end_.own && monitor_.cost() < fine.from_start->cost - kGainedTime;
      }
    }
    if (!Safest()) AddMultipliers(program, monitor_.incumbent(), &monitor_.result().junctions);
    NoteStop();
    std::string message = end_.Sentence();
    if (Safest() && !std::isfinite(monitor_.cost())) {
      message += Formatted("; no walk of at most %f s was proved, the dichotomy's is kept",
                           program.duration_limit());
    }
    return monitor_.Finish(end_.Ending(), message);
  }

  void NoteStop() {
    end_.stopped = monitor_.interrupted();
    end_.deadline_passed = end_.deadline_passed || (monitor_.stopped() && !end_.stopped);
  }

  const WalkProblem& problem_;
  const OptimizerOptions& options_;
  const opt::Solver& solver_;
  const Stages& stages_;
  SmoothingMonitor& monitor_;
  double search_from_ = 0.2;  // of the progress
  bool found_apart_ = false;  // what is not from SearchWhole
  std::string start_message_;
  SearchEnding end_;
};

}  // namespace

SmoothingResult OptimizeOverlaps(const WalkProblem& problem, const OptimizerOptions& options,
                                 SmoothingMonitor& monitor) {
  std::shared_ptr<const opt::Solver> solver = options.own_solver;
  if (!solver) solver = opt::MakeSolver(options.solver);
  const opt::SolverTraits traits = solver->traits();
  OptimizerOptions own = options;
  own.program.watch = RowsFor(traits, problem.test(), kRowsInstants, own.program.watch);
  if (own.instants > 0) own.program.watch.instants = own.instants;
  if (own.max_iterations == 0) own.max_iterations = traits.iterations;
  return Optimization(problem, own, *solver, Stages(), monitor).Run();
}

}  // namespace halfstep
