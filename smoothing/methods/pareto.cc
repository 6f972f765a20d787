#include "smoothing/methods/pareto.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "smoothing/methods/dichotomy.h"
#include "wpg/check.h"
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

}  // namespace

SmoothingResult ParetoCurve(const WalkProblem& problem, const OptimizerOptions& options,
                            const ParetoOptions& pareto, SmoothingMonitor& monitor) {
  HALFSTEP_CHECK(pareto.points >= 2 && pareto.most_duration > 0.0, "points = " << pareto.points);
  const double parts = pareto.points + 2.0;
  int part = 0;
  const double planned = DurationOf(problem.Start());
  const SmoothingResult dichotomy = BeginWithDichotomy(problem, options.tolerance, monitor);
  if (!dichotomy.feasible || monitor.stopped()) {
    return monitor.Finish(opt::Ending::kNotRun, dichotomy.message);
  }
  const double own = DurationOf(dichotomy.parameters);
  // The solves share what is left of the deadline evenly; what one does not need others have.
  const auto share = [&] {
    return (options.deadline - monitor.Seconds()) / std::max(1.0, parts - part);
  };
  const auto over = [&] { return monitor.stopped() || share() <= 0.0; };

  std::vector<ParetoPoint>& points = monitor.result().pareto;
  opt::Ending weakest = opt::Ending::kConverged;  // of the solves that found something
  const auto solve = [&](ProgramKind kind, double limit, const HomotopyParameters& start) {
    OptimizerOptions with = options;
    with.program.kind = kind;
    with.duration_limit = limit;
    with.start = start;
    const double begun = monitor.Seconds();
    SmoothingMonitor within(monitor.Part(part / parts, (part + 1) / parts));
    within.LimitTo(std::max(0.0, share()));
    SmoothingResult result = OptimizeOverlaps(problem, with, within);
    ++part;
    if (opt::HasOwnResult(result.ending)) weakest = std::max(weakest, result.ending);
    monitor.Count(result);
    monitor.result().raw_infeasible += result.raw_infeasible;
    for (SmoothingIterate iterate : result.iterates) {
      iterate.wall += begun;
      monitor.result().iterates.push_back(iterate);
    }
    if (kind == ProgramKind::kSafest && std::isfinite(result.cost)) {
      points.push_back({DurationOf(result.parameters), -result.cost, result.parameters});
    }
    return result;
  };
  const SmoothingResult fastest = solve(ProgramKind::kFastest, 0.0, dichotomy.parameters);
  const SmoothingResult same = solve(ProgramKind::kSafest, own, dichotomy.parameters);
  if (same.accepted) monitor.Adopt(*same.accepted, same.cost, DurationOf(same.parameters));
  monitor.result().junctions = same.junctions;

  const double least = DurationOf(fastest.parameters);
  const double most = std::max(least, pareto.most_duration * planned);
  HomotopyParameters start = fastest.parameters;
  for (int i = 0; i < pareto.points && !over(); ++i) {
    const double duration = least * std::pow(most / least, i / (pareto.points - 1.0));
    // From the safer one of the walk before and the one at the dichotomy's duration.
    const bool from_same =
        own <= duration && !points.empty() && (i == 0 || -same.cost > points.back().least_slack);
    start = solve(ProgramKind::kSafest, duration, from_same ? same.parameters : start).parameters;
  }
  std::stable_sort(points.begin(), points.end(), [](const ParetoPoint& a, const ParetoPoint& b) {
    return a.duration < b.duration;
  });
  points = Undominated(points);
  if (over()) weakest = std::max(weakest, monitor.StopEnding());
  const opt::Ending ending = opt::HasOwnResult(same.ending) ? weakest : same.ending;
  const std::string late = over() ? monitor.StopReason() + "; " : "";
  return monitor.Finish(ending, late + Sentence(options.solver, points.size(), least, most, same));
}

}  // namespace halfstep
