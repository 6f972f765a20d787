#include "smoothing/methods/overlap_optimizer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "opt/adapters/solver_registry.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/overlap_prices.h"
#include "smoothing/methods/search_ending.h"
#include "smoothing/methods/whole_proof.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// A search that does not beat a plain dichotomy by this has found nothing [s].
constexpr double kGainedTime = 1e-9;
// Of the effort, which a dichotomy may use at least.
constexpr double kBaselinePart = 0.5;
// Of the effort, what a first walk may take where the planned motion is not feasible.
constexpr double kFirstPart = 0.5;

class Optimization {
 public:
  Optimization(const WalkProblem& problem, const OptimizerOptions& options,
               std::shared_ptr<const opt::Solver> solver, SmoothingMonitor& monitor)
      : problem_(problem),
        options_(options),
        solver_(std::move(solver)),
        monitor_(monitor),
        end_{.solver = options.solver,
             .kept = options.begin ? "the walk is what it started from"
                                   : "the walk is the planned motion"} {}

  SmoothingResult Run() {
    monitor_.LimitTo(options_.effort, options_.deadline);
    const HomotopyParameters begin = options_.begin.value_or(problem_.Start());
    if (!monitor_.BeginFeasibly(problem_, begin) && !FoundFirst()) {
      return monitor_.Refusal(missed_.empty() ? opt::Ending::kNotRun : opt::Ending::kNoImprovement,
                              missed_);
    }
    if (!Safest() && !Fastest()) {  // the monitor takes costs for durations
      const HomotopyParameters& first = monitor_.accepted()->parameters();
      monitor_.Adopt(*monitor_.accepted(), CostAt(first), DurationOf(first));
    }
    const SearchStart start = Safest() || options_.begin ? SearchStart::kDichotomy : options_.start;
    if (start == SearchStart::kDichotomy && !options_.begin) {
      TakeDichotomy(problem_.Start(), options_.tolerance);
    }
    if (monitor_.stopped()) return CutOff();
    const double own = DurationOf(monitor_.incumbent());
    const double limit = options_.duration_limit > 0.0 ? options_.duration_limit : own;
    const RangeOptions range = Range(limit);
    const double effort = (1.0 - options_.tuning.last_part) * monitor_.effort();
    const AcceptedWalk begun = *monitor_.accepted();
    const double cost = monitor_.cost();
    end_.own = RunStages(problem_, StagesOf(start), start, range, effort, monitor_, &end_);
    if (end_.own && !Safest()) {  // whose walks were proved whole
      KeepWhatHolds(problem_, begun, cost, monitor_);
      end_.own = monitor_.incumbent() != begun.parameters();
    }
    return Conclude(limit);
  }

 private:
  bool Safest() const { return options_.program.kind == ProgramKind::kSafest; }
  bool Fastest() const { return options_.program.kind == ProgramKind::kFastest; }

  RangeOptions Range(double duration_limit) const {
    return {.solver = solver_,
            .program = options_.program,
            .duration_limit = duration_limit,
            .iterations = options_.max_iterations,
            .rounds = options_.rounds,
            .tuning = options_.tuning};
  }

  // Whether a walk is the incumbent now that was found though the planned motion is not feasible.
  // Its rests on one foot may be what no parameter mends, while walks without them are feasible.
  bool FoundFirst() {
    const bool looks = !options_.begin && !Safest() && options_.start == SearchStart::kTypical &&
                       !monitor_.interrupted();
    if (!looks) return false;
    SearchEnding first = end_;
    if (FindFirst(problem_, Range(0.0), kFirstPart * monitor_.effort(), monitor_, &first)) {
      monitor_.DropStart();
      found_first_ = true;
      first.cut = opt::Ending::kNotRun;
      first.why_cut.clear();
      first.exhausted = false;
      end_ = first;
      return true;
    }
    if (first.called) {
      missed_ = "; from typical forms no walk was proved either";
      if (first.last_violation > 0.0) {
        missed_ += Formatted(", %s stayed violated by at least %.2g", first.last_violated.c_str(),
                             first.last_violation);
      }
    }
    return false;
  }

  // What a walk costs before the search; `safest` knows it only over the whole program.
  double CostAt(const HomotopyParameters& walk) const {
    return Safest() ? DurationOf(walk) : CostOf(problem_.sequence(), walk, options_.program);
  }

  std::vector<SearchStage> StagesOf(SearchStart start) const {
    if (options_.only) return {*options_.only};
    const SearchTuning& tuning = options_.tuning;
    std::vector<SearchStage> stages;
    const bool by_windows = options_.windows && !Safest() && solver_->traits().many_rows &&
                            problem_.scene().rests() &&
                            problem_.sequence().size() > tuning.long_walk;
    if (by_windows) {
      stages.push_back(
          {.window = tuning.window, .step = tuning.step, .rounds = tuning.window_rounds});
    }
    if (start == SearchStart::kTypical && !by_windows &&
        options_.program.parameters.support_points) {
      stages.push_back({.rounds = options_.rounds, .resting = true});
    }
    stages.push_back({.rounds = options_.rounds});
    return stages;
  }

  // A dichotomy from `start`, or from the incumbent where that is it; its walk becomes the
  // incumbent where it is shorter.
  void TakeDichotomy(const HomotopyParameters& start, double tolerance) {
    DichotomyOptions dichotomy{.tolerance = tolerance};
    const bool from_incumbent = start == monitor_.incumbent();
    if (from_incumbent) {
      dichotomy.accepted_start = *monitor_.accepted();
    } else {
      dichotomy.start = start;
    }
    MonitorOptions part = monitor_.Part(0.9, 1.0);
    // A solver that took more than its part of the effort leaves the baseline its own.
    part.effort = std::max(part.effort, kBaselinePart * monitor_.effort());
    SmoothingMonitor within(part);
    const SmoothingResult found = Dichotomy(problem_, dichotomy, within);
    const double effort = monitor_.work().effort();
    monitor_.Count(found);
    if (!found.accepted || (!from_incumbent && !(found.cost < monitor_.cost()))) return;
    for (SmoothingIterate iterate : found.iterates) {
      if (iterate.incumbent_duration > monitor_.duration()) continue;
      iterate.wall += monitor_.Seconds() - found.wall;
      iterate.instants += monitor_.work().evaluated() - found.work.evaluated();
      iterate.effort += effort;
      monitor_.result().iterates.push_back(iterate);
    }
    monitor_.Adopt(*found.accepted, CostAt(found.parameters), DurationOf(found.parameters));
    if (!options_.begin) end_.kept = "the walk is a dichotomy's";
    monitor_.result().junctions = found.junctions;
  }

  // What no dichotomy from the planned motion gets below: with every overlap at its natural bound.
  double LeastOfDichotomy() const {
    HomotopyParameters start = problem_.Start();
    for (int i = 0; i < problem_.sequence().num_junctions(); ++i) {
      Nth(start.overlaps, i) = std::max(Nth(start.overlaps, i), NaturalOverlapBound(start, i));
    }
    return DurationOf(start);
  }

  SmoothingResult Conclude(double limit) {
    if (Fastest() && !monitor_.cut_off()) {
      const AcceptedWalk searched = *monitor_.accepted();
      const double cost = monitor_.cost();
      TakeDichotomy(monitor_.incumbent(), options_.tolerance);
      KeepWhatHolds(problem_, searched, cost, monitor_);
      if (!options_.begin && monitor_.cost() > LeastOfDichotomy()) {
        const double before = monitor_.cost();
        TakeDichotomy(problem_.Start(), options_.tolerance);
        end_.own = end_.own && monitor_.cost() >= before - kGainedTime;
      }
    } else {
      for (JunctionResult& junction : monitor_.result().junctions) junction.limited_by.reset();
    }
    if (!Safest()) AddMultipliers();
    end_.own = end_.own || found_first_;
    if (monitor_.stopped()) end_.NoteCut(monitor_);
    std::string message = end_.Sentence();
    if (Safest() && !std::isfinite(monitor_.cost())) {
      message += Formatted("; no walk of at most %f s was proved, the dichotomy's is kept", limit);
    }
    return monitor_.Finish(end_.Ending(), message);
  }

  void AddMultipliers() {
    ProgramOptions sharp = options_.program;
    sharp.watch.row_per_instant = true;
    sharp.watch.sharpness = options_.tuning.sharpness;
    OverlapProgram program(problem_.sequence(), problem_.evaluator(), sharp, 0.0, problem_.fixed());
    program.watched().SetWorkers(monitor_.workers());
    program.watched().SetWork(&monitor_.scratch()->work);
    program.watched().Focus(SuperposedWalk(problem_.sequence(), monitor_.incumbent()),
                            options_.tuning.look_period, 0.0);
    monitor_.Count({.linear_algebra = halfstep::AddMultipliers(program, monitor_.incumbent(),
                                                               &monitor_.result().junctions)},
                   0);
  }

  SmoothingResult CutOff() {
    end_.own = found_first_;
    end_.NoteCut(monitor_);
    return monitor_.Finish(end_.Ending(), end_.Sentence());
  }

  const WalkProblem& problem_;
  const OptimizerOptions& options_;
  const std::shared_ptr<const opt::Solver> solver_;
  SmoothingMonitor& monitor_;
  SearchEnding end_;
  bool found_first_ = false;  // by FindFirst
  std::string missed_;        // where that found none
};

}  // namespace

SmoothingResult OptimizeOverlaps(const WalkProblem& problem, const OptimizerOptions& options,
                                 SmoothingMonitor& monitor) {
  std::shared_ptr<const opt::Solver> solver = options.own_solver;
  if (!solver) solver = opt::MakeSolver(options.solver);
  OptimizerOptions own = options;
  if (own.instants > 0) own.program.watch.instants = own.tuning.instants = own.instants;
  if (own.max_iterations == 0) own.max_iterations = solver->traits().iterations;
  return Optimization(problem, own, std::move(solver), monitor).Run();
}

}  // namespace halfstep
