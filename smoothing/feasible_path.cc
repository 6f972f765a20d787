#include "smoothing/feasible_path.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "smoothing/superposed_walk.h"

namespace halfstep {

double DurationOf(const HomotopyParameters& parameters) {
  return std::accumulate(parameters.durations.begin(), parameters.durations.end(), 0.0) -
         std::accumulate(parameters.overlaps.begin(), parameters.overlaps.end(), 0.0);
}

FeasiblePath::FeasiblePath(const HalfStepSequence& sequence, const FeasibilityTest& test,
                           HomotopyParameters start, Cost cost)
    : sequence_(sequence),
      test_(test),
      cost_(std::move(cost)),
      incumbent_(std::move(start)),
      cost_of_incumbent_(cost_(incumbent_)),
      scratch_(test.evaluator().MakeScratch()) {}

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
  constexpr double kImprovement = 1e-9;
  const double cost = cost_(point);
  if (!(cost < cost_of_incumbent_ - kImprovement)) return false;
  const SuperposedWalk walk(sequence_, point);
  if (test_.Check(walk, {0.0, walk.duration()}, &scratch_).verdict != Verdict::kFeasible) {
    ++refused_;
    return false;
  }
  incumbent_ = point;
  cost_of_incumbent_ = cost;
  return true;
}

double FeasiblePath::Toward(const HomotopyParameters& candidate) {
  constexpr int kBisections = 5;
  if (!(cost_(Between(candidate, 1.0)) < cost_of_incumbent_)) return 0.0;
  if (Accept(Between(candidate, 1.0))) return 1.0;
  double feasible = 0.0, infeasible = 1.0;
  for (int k = 0; k < kBisections; ++k) {
    const double middle = 0.5 * (feasible + infeasible);
    // The incumbent is at `feasible` of the way by now.
    const double onwards = (middle - feasible) / (1.0 - feasible);
    (Accept(Between(candidate, onwards)) ? feasible : infeasible) = middle;
  }
  return feasible;
}

}  // namespace halfstep
