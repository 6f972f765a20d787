#include "smoothing/methods/pareto.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "smoothing/methods/dichotomy.h"
#include "wpg/check.h"

namespace halfstep {

SmoothingResult ParetoCurve(const HalfStepSequence& sequence, const FeasibilityTest& test,
                            const OptimizerOptions& options, const ParetoOptions& pareto,
                            const std::function<void(double)>& progress, std::stop_token stop) {
  HALFSTEP_CHECK(pareto.points >= 2 && pareto.most_duration > 0.0, "points = " << pareto.points);
  const double parts = pareto.points + 2.0;
  int part = 0;
  const auto of_part = [&](double done) {
    if (progress) progress((part + done) / parts);
  };
  SmoothingResult total = Dichotomy(sequence, test, {.tolerance = options.tolerance}, {}, stop);
  if (!total.feasible || stop.stop_requested()) {
    total.ending = opt::Ending::kNotRun;
    return total;
  }
  const double own = DurationOf(total.parameters);

  opt::Ending weakest = opt::Ending::kConverged;  // of the solves that found something
  const auto solve = [&](ProgramKind kind, double limit, const HomotopyParameters& start) {
    OptimizerOptions with = options;
    with.program.kind = kind;
    with.duration_limit = limit;
    with.start = start;
    SmoothingResult result = OptimizeOverlaps(sequence, test, with, of_part, stop);
    ++part;
    if (opt::HasOwnResult(result.ending)) weakest = std::max(weakest, result.ending);
    total.instants += result.instants;
    total.collision_queries += result.collision_queries;
    total.raw_infeasible += result.raw_infeasible;
    for (SmoothingIterate iterate : result.iterates) {
      iterate.wall += total.wall;
      total.iterates.push_back(iterate);
    }
    total.wall += result.wall;
    if (kind == ProgramKind::kSafest && std::isfinite(result.cost)) {
      total.pareto.push_back({DurationOf(result.parameters), -result.cost, result.parameters});
    }
    return result;
  };
  const SmoothingResult fastest = solve(ProgramKind::kFastest, 0.0, total.parameters);
  const SmoothingResult same = solve(ProgramKind::kSafest, own, total.parameters);
  total.parameters = same.parameters;
  total.junctions = same.junctions;
  total.cost = same.cost;

  const double least = DurationOf(fastest.parameters);
  const double most = std::max(least, pareto.most_duration * DurationOf(PlannedMotion(sequence)));
  HomotopyParameters start = fastest.parameters;
  for (int i = 0; i < pareto.points && !stop.stop_requested(); ++i) {
    const double duration = least * std::pow(most / least, i / (pareto.points - 1.0));
    // From the safer one of the walk before and the one at the dichotomy's duration.
    const bool from_same = own <= duration && !total.pareto.empty() &&
                           (i == 0 || -same.cost > total.pareto.back().least_slack);
    start = solve(ProgramKind::kSafest, duration, from_same ? same.parameters : start).parameters;
  }
  std::stable_sort(
      total.pareto.begin(), total.pareto.end(),
      [](const ParetoPoint& a, const ParetoPoint& b) { return a.duration < b.duration; });
  total.message = options.solver + ": safest walks of " + std::to_string(total.pareto.size()) +
                  " durations from " + std::to_string(least) + " to " + std::to_string(most) + " s";
  total.ending = opt::HasOwnResult(same.ending) ? weakest : same.ending;
  total.message += "; at the dichotomy's duration " + same.message;
  return total;
}

}  // namespace halfstep
