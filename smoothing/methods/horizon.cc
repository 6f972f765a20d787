#include "smoothing/methods/horizon.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <vector>

#include "opt/adapters/solver_registry.h"
#include "smoothing/methods/accepted_in_parts.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/search_ending.h"
#include "smoothing/methods/walk_window.h"
#include "smoothing/methods/whole_proof.h"
#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// Of the dichotomy before the windows, for solvers that take long steps and for others [s].
constexpr double kFarBegin = 0.5, kNearBegin = 0.1;
// A search that does not beat a plain dichotomy by this has found nothing [s].
constexpr double kBeatsDichotomy = 1e-9;

class HorizonSearch {
 public:
  HorizonSearch(const WalkProblem& problem, const HorizonOptions& options,
                SmoothingMonitor& monitor)
      : problem_(problem),
        options_(options),
        monitor_(monitor),
        solver_(opt::MakeSolver(options.solver)),
        end_{.solver = options.solver, .kept = "the walk is a dichotomy's"} {}

  SmoothingResult Run() {
    at_ = problem_.Start();
    if (!monitor_.BeginFeasibly(problem_, at_)) return monitor_.Refusal();
    if (options_.program.kind == ProgramKind::kSafest) {
      return monitor_.Finish(opt::Ending::kInvalidInput,
                             "halfstep/horizon has no program `safest` or `pareto` (valid: "
                             "fastest, smooth); the walk is the one it began with");
    }
    const double coarse = solver_->traits().long_steps ? kFarBegin : kNearBegin;
    Adopt(Cost(at_));
    Dichotomize(Fastest() ? std::max(options_.tolerance, coarse) : options_.tolerance, 0.0, 0.2);
    Search();
    Conclude();
    return monitor_.Finish(end_.Ending(), end_.Sentence());
  }

 private:
  bool Fastest() const { return options_.program.kind == ProgramKind::kFastest; }
  int size() const { return problem_.sequence().size(); }

  double Cost(const HomotopyParameters& parameters) const {
    return CostOf(problem_.sequence(), parameters, options_.program);
  }

  // at_ was proved in parts: of a proved walk, window by window.
  void Adopt(double cost) { monitor_.Adopt(AcceptedInParts::Walk(at_), cost, DurationOf(at_)); }

  // Bisects every overlap of at_ in turn, window by window, and adopts what becomes of it.
  void Dichotomize(double tolerance, double from, double to) {
    double cost = monitor_.cost();
    for (int first = 0; first < size() && !monitor_.stopped(); first += options_.window) {
      const int last = std::min(first + options_.window, size()) - 1;
      const WalkWindow window = WindowOf(problem_, at_, first, last);
      const double begins =
          std::accumulate(at_.durations.begin(), at_.durations.begin() + window.begin, 0.0) -
          std::accumulate(at_.overlaps.begin(), at_.overlaps.begin() + window.begin, 0.0);
      SmoothingMonitor within(Part(0.0, 0.0));
      const SmoothingResult part = Dichotomy(
          window.problem,
          {.tolerance = tolerance, .accepted_start = AcceptedInParts::Walk(window.parameters)},
          within);
      const double elsewhere = DurationOf(at_) - DurationOf(window.parameters);
      monitor_.Count(part);
      for (SmoothingIterate iterate : part.iterates) {
        iterate.wall += monitor_.Seconds() - part.wall;
        iterate.instants = monitor_.instants();
        iterate.candidate_duration += elsewhere;
        iterate.incumbent_duration += elsewhere;
        iterate.incumbent_cost = iterate.incumbent_duration;
        monitor_.result().iterates.push_back(iterate);
      }
      for (int j = std::max(0, first - 1); j < last; ++j) {
        std::optional<Margin> limit = Nth(part.junctions, j - window.begin).limited_by;
        if (limit) {
          limit->at.half_step += window.begin;
          limit->t += begins;
          if (limit->stop_after >= 0) limit->stop_after += window.begin;
        }
        Nth(monitor_.result().junctions, j).limited_by = limit;
      }
      window.Paste(part.parameters, &at_);
      cost = DurationOf(at_);
      if (Fastest() && cost < monitor_.cost()) Adopt(cost);
      if (!alone_) monitor_.Progress(from + (to - from) * (last + 1) / size());
    }
    if (!Fastest() && (cost = Cost(at_)) < monitor_.cost()) Adopt(cost);
  }

  void Search() {
    end_.own = SearchWindows(problem_, options_, *solver_, 0.2, 0.8, monitor_, &end_);
    at_ = monitor_.incumbent();
  }

  void Conclude() {
    if (Fastest() && !monitor_.stopped()) {
      FineDichotomies();
    } else {
      for (JunctionResult& junction : monitor_.result().junctions) junction.limited_by.reset();
    }
    end_.stopped = monitor_.interrupted();
    end_.deadline_passed = end_.deadline_passed || (monitor_.stopped() && !end_.stopped);
  }

  // One from the incumbent and one from the planned motion, at the same time where there are
  // workers; the shorter walk counts.
  void FineDichotomies() {
    const AcceptedWalk searched = *monitor_.accepted();
    const double cost = monitor_.cost();
    SmoothingResult plain;
    alone_ = monitor_.workers() != nullptr;
    RunWith(monitor_.workers(), 2, [&](int index, int) {
      if (index == 0) {
        Dichotomize(options_.tolerance, 0.8, 0.9);
      } else {
        plain = PlainDichotomy();
      }
      return true;
    });
    alone_ = false;
    KeepWhatHolds(problem_, searched, cost, monitor_);
    at_ = monitor_.incumbent();
    TakePlain(plain);
  }

  // Of the planned motion. Changes nothing here.
  SmoothingResult PlainDichotomy() const {
    SmoothingMonitor within(Part(0.9, 1.0));
    HorizonSearch plain(problem_, options_, within);
    plain.at_ = problem_.Start();
    within.BeginAccepted(problem_, AcceptedInParts::Walk(plain.at_));  // Run() has begun with it
    plain.Dichotomize(options_.tolerance, 0.0, 1.0);
    return within.Finish(opt::Ending::kConverged, "");
  }

  // What a search within this one is given. Where two run at once each has its own thread only,
  // and the caller, who hears of progress from its own thread, hears nothing.
  MonitorOptions Part(double from, double to) const {
    MonitorOptions part = monitor_.Part(from, to);
    if (!alone_) return part;
    part.workers = nullptr;
    part.progress = {};
    return part;
  }

  void TakePlain(const SmoothingResult& found) {
    monitor_.Count(found);
    end_.own = end_.own && monitor_.cost() < found.cost - kBeatsDichotomy;
    if (!(found.cost < monitor_.cost())) return;
    const double before = monitor_.cost();
    for (SmoothingIterate iterate : found.iterates) {
      if (iterate.incumbent_duration > before) continue;
      iterate.wall += monitor_.Seconds() - found.wall;
      iterate.instants = monitor_.instants();
      monitor_.result().iterates.push_back(iterate);
    }
    monitor_.result().junctions = found.junctions;
    at_ = found.parameters;
    Adopt(found.cost);
  }

  const WalkProblem& problem_;
  const HorizonOptions& options_;
  SmoothingMonitor& monitor_;
  std::unique_ptr<opt::Solver> solver_;
  HomotopyParameters at_;  // what dichotomies begin at
  bool alone_ = false;     // another search runs at the same time
  SearchEnding end_;
};

}  // namespace

SmoothingResult Horizon(const WalkProblem& problem, const HorizonOptions& options,
                        SmoothingMonitor& monitor) {
  HALFSTEP_CHECK(options.window >= 2 && options.window % 2 == 0, "window = " << options.window);
  HALFSTEP_CHECK(options.step >= 2 && options.step % 2 == 0 && options.step <= options.window,
                 "step = " << options.step);
  HALFSTEP_CHECK(options.passes >= 1, "passes = " << options.passes);
  return HorizonSearch(problem, options, monitor).Run();
}

}  // namespace halfstep
