#include "smoothing/methods/pareto.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "smoothing/methods/dichotomy.h"
#include "wpg/check.h"
#include "wpg/elementary.h"
#include "wpg/files/text.h"

namespace halfstep {

namespace {

// What an earlier, shorter walk does at least as safely is left out, `points` being sorted by
// duration.
std::vector<ParetoPoint> Undominated(const std::vector<ParetoPoint>& points) {
  constexpr double kSafer = 1e-3;  // of a slack's scale: what a search for safer walks asks for
  std::vector<ParetoPoint> kept;
  for (const ParetoPoint& point : points) {
    if (!kept.empty() && point.least_slack <= kept.back().least_slack + kSafer) continue;
    if (!kept.empty() && point.duration <= kept.back().duration) kept.pop_back();
    kept.push_back(point);
  }
  return kept;
}

std::string Sentence(const std::string& solver, size_t points, double least, double most,
                     const SmoothingResult& same) {
  return solver +
         Formatted(": safest walks of %zu durations from %f to %f s; at the dichotomy's duration ",
                   points, least, most) +
         same.message;
}

// The dichotomy's walk, which the curve is measured against, becomes the incumbent.
SmoothingResult BeginWithDichotomy(const WalkProblem& problem, double tolerance,
                                   SmoothingMonitor& monitor) {
  monitor.Begin(problem, problem.Start());
  SmoothingMonitor within(monitor.Part(0.0, 0.0));
  SmoothingResult dichotomy = Dichotomy(problem, {.tolerance = tolerance}, within);
  monitor.Count(dichotomy);
  monitor.result().iterates = dichotomy.iterates;
  monitor.result().junctions = dichotomy.junctions;
  const double own = DurationOf(dichotomy.parameters);
  if (dichotomy.accepted) monitor.Adopt(*dichotomy.accepted, own, own);
  return dichotomy;
}

// Solves one after the other; they share what is left of the effort evenly, and what one does not
// need others have.
class CurveSolves {
 public:
  // Of at most `count` solves; all is borrowed.
  CurveSolves(const WalkProblem& problem, const OptimizerOptions& options, int count,
              SmoothingMonitor& monitor)
      : problem_(problem), options_(options), monitor_(monitor), count_(count) {}

  SmoothingResult Solve(ProgramKind kind, double limit, const HomotopyParameters& start) {
    OptimizerOptions with = options_;
    with.program.kind = kind;
    with.duration_limit = limit;
    with.begin = start;
    const double begun = monitor_.Seconds(), used = monitor_.work().effort();
    SmoothingMonitor within(monitor_.Part(done_ / count_, (done_ + 1) / count_));
    with.effort = std::max(0.0, Share());
    SmoothingResult result = OptimizeOverlaps(problem_, with, within);
    ++done_;
    if (opt::HasOwnResult(result.ending)) weakest_ = std::max(weakest_, result.ending);
    monitor_.Count(result);
    monitor_.result().raw_infeasible += result.raw_infeasible;
    for (SmoothingIterate iterate : result.iterates) {
      iterate.wall += begun;
      iterate.effort += used;
      monitor_.result().iterates.push_back(iterate);
    }
    if (kind == ProgramKind::kSafest && std::isfinite(result.cost)) {
      monitor_.result().pareto.push_back(
          {DurationOf(result.parameters), -result.cost, result.parameters});
    }
    return result;
  }

  bool over() const { return monitor_.stopped() || Share() <= 0.0; }
  opt::Ending weakest() const { return weakest_; }  // of the solves that found something

 private:
  double Share() const { return monitor_.EffortLeft() / std::max(1.0, count_ - done_); }

  const WalkProblem& problem_;
  const OptimizerOptions& options_;
  SmoothingMonitor& monitor_;
  double count_;
  int done_ = 0;
  opt::Ending weakest_ = opt::Ending::kConverged;
};

}  // namespace

SmoothingResult ParetoCurve(const WalkProblem& problem, const OptimizerOptions& options,
                            const ParetoOptions& pareto, SmoothingMonitor& monitor) {
  HALFSTEP_CHECK(pareto.points >= 2 && pareto.most_duration > 0.0, "points = " << pareto.points);
  monitor.LimitTo(options.effort, options.deadline);
  const double planned = DurationOf(problem.Start());
  const SmoothingResult dichotomy = BeginWithDichotomy(problem, options.tolerance, monitor);
  if (!dichotomy.feasible || monitor.stopped()) {
    return monitor.Finish(opt::Ending::kNotRun, dichotomy.message);
  }
  const double own = DurationOf(dichotomy.parameters);
  CurveSolves solves(problem, options, pareto.points + 2, monitor);
  const SmoothingResult fastest = solves.Solve(ProgramKind::kFastest, 0.0, dichotomy.parameters);
  const SmoothingResult same = solves.Solve(ProgramKind::kSafest, own, dichotomy.parameters);
  if (same.accepted) monitor.Adopt(*same.accepted, same.cost, DurationOf(same.parameters));
  monitor.result().junctions = same.junctions;

  std::vector<ParetoPoint>& points = monitor.result().pareto;
  const double least = DurationOf(fastest.parameters);
  const double most = std::max(least, pareto.most_duration * planned);
  HomotopyParameters start = fastest.parameters;
  for (int i = 0; i < pareto.points && !solves.over(); ++i) {
    const double duration = least * Pow(most / least, i / (pareto.points - 1.0));
    // From the safer one of the walk before and the one at the dichotomy's duration.
    const bool from_same =
        own <= duration && !points.empty() && (i == 0 || -same.cost > points.back().least_slack);
    start = solves.Solve(ProgramKind::kSafest, duration, from_same ? same.parameters : start)
                .parameters;
  }
  std::stable_sort(points.begin(), points.end(), [](const ParetoPoint& a, const ParetoPoint& b) {
    return a.duration < b.duration;
  });
  points = Undominated(points);
  const bool late = solves.over();
  const opt::Ending weakest =
      late ? std::max(solves.weakest(), monitor.StopEnding()) : solves.weakest();
  return monitor.Finish(opt::HasOwnResult(same.ending) ? weakest : same.ending,
                        (late ? monitor.StopReason() + "; " : "") +
                            Sentence(options.solver, points.size(), least, most, same));
}

}  // namespace halfstep
