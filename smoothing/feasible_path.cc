#include "smoothing/feasible_path.h"

#include <algorithm>
#include <utility>

#include "smoothing/changed_windows.h"
#include "smoothing/superposed_walk.h"

namespace halfstep {

FeasiblePath::FeasiblePath(const HalfStepSequence& sequence, Rules rules, HomotopyParameters start,
                           double cost, MarginEvaluator::Scratch scratch)
    : sequence_(sequence),
      rules_(std::move(rules)),
      incumbent_(std::move(start)),
      cost_(cost),
      scratch_(std::move(scratch)) {}

HomotopyParameters FeasiblePath::Between(const HomotopyParameters& candidate, double lambda) const {
  const auto mix = [lambda](const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> c(a.size());
    for (size_t i = 0; i < a.size(); ++i) c[i] = a[i] + lambda * (b[i] - a[i]);
    return c;
  };
  HomotopyParameters point{mix(incumbent_.overlaps, candidate.overlaps),
                           mix(incumbent_.height_scales, candidate.height_scales),
                           mix(incumbent_.durations, candidate.durations)};
  for (int i = 0; i < sequence_.num_junctions(); ++i) {
    double& overlap = point.overlaps[static_cast<size_t>(i)];
    overlap = std::clamp(overlap, 0.0, NaturalOverlapBound(sequence_, point.durations, i));
  }
  return point;
}

bool FeasiblePath::Accept(const HomotopyParameters& point) {
  const double cost = rules_.cost(point);
  if (!(cost < cost_ - rules_.improvement)) return false;
  const Feasibility answer =
      rules_.prove(SuperposedWalk(sequence_, point), cost, incumbent_, &scratch_);
  if (answer.verdict != Verdict::kFeasible) {
    ++refused_;
    if (!refusal_) refusal_ = answer.witness;
    return false;
  }
  ++accepted_;
  incumbent_ = point;
  cost_ = cost;
  if (rules_.accepted) rules_.accepted(point);
  return true;
}

double FeasiblePath::Toward(const HomotopyParameters& candidate, int bisections) {
  refusal_.reset();
  const HomotopyParameters whole = Between(candidate, 1.0);
  if (!(rules_.cost(whole) < cost_ - rules_.improvement)) return 0.0;
  if (Accept(whole)) return 1.0;
  double feasible = 0.0, infeasible = 1.0;
  for (int k = 0; k < bisections; ++k) {
    const double middle = 0.5 * (feasible + infeasible);
    // The incumbent is at `feasible` of the way by now.
    const double onwards = (middle - feasible) / (1.0 - feasible);
    (Accept(Between(candidate, onwards)) ? feasible : infeasible) = middle;
  }
  return feasible;
}

Feasibility CheckChanges(const FeasibilityTest& test, const SuperposedWalk& walk,
                         const HomotopyParameters& incumbent, MarginEvaluator::Scratch* scratch) {
  for (const TimeWindow& window : ChangedWindows(incumbent, walk)) {
    const Feasibility answer = test.Check(walk, window, scratch);
    if (answer.verdict != Verdict::kFeasible) return answer;
  }
  return {Verdict::kFeasible, test.evidence(), {}};
}

}  // namespace halfstep
