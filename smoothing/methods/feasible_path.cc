#include "smoothing/methods/feasible_path.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

FeasiblePath::FeasiblePath(const HalfStepSequence& sequence, Rules rules, HomotopyParameters start,
                           double cost, MarginEvaluator::Scratch scratch)
    : sequence_(sequence),
      rules_(std::move(rules)),
      incumbent_(std::move(start)),
      cost_(cost),
      scratch_(std::move(scratch)) {}

HomotopyParameters FeasiblePath::Between(const HomotopyParameters& candidate,
                                         const std::vector<double>& lambda) const {
  HomotopyParameters point = incumbent_;
  const auto move = [](double to, double part, double* value) { *value += part * (to - *value); };
  const size_t n = lambda.size();
  for (size_t k = 0; k < n; ++k) {
    move(candidate.durations[k], lambda[k], &point.durations[k]);
    if (k % 2 == 0) {
      const double part = k + 1 < n ? std::min(lambda[k], lambda[k + 1]) : lambda[k];
      move(candidate.height_scales[k / 2], part, &point.height_scales[k / 2]);
    }
    if (k + 1 < n) {
      move(candidate.overlaps[k], std::min(lambda[k], lambda[k + 1]), &point.overlaps[k]);
    }
  }
  for (int i = 0; i < sequence_.num_junctions(); ++i) {
    double& overlap = point.overlaps[static_cast<size_t>(i)];
    overlap = std::clamp(overlap, 0.0, NaturalOverlapBound(sequence_, point.durations, i));
  }
  return point;
}

double FeasiblePath::Toward(const HomotopyParameters& candidate, int attempts) {
  constexpr double kLeastPart = 0.4;  // below it: none
  refusals_.clear();
  const size_t n = candidate.durations.size();
  std::vector<double> lambda(n, 1.0);
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const HomotopyParameters point = Between(candidate, lambda);
    const double cost = rules_.cost(point);
    if (!(cost < cost_ - rules_.improvement)) return 0.0;
    const std::vector<Margin> refusals =
        rules_.prove(SuperposedWalk(sequence_, point), cost, &scratch_);
    if (refusals.empty()) {
      ++accepted_;
      incumbent_ = point;
      cost_ = cost;
      if (rules_.accepted) rules_.accepted(point);
      return std::accumulate(lambda.begin(), lambda.end(), 0.0) / static_cast<double>(n);
    }
    ++refused_;
    if (attempt == 0) refusals_ = refusals;
    std::vector<bool> held(n, !rules_.local);
    for (const Margin& refusal : refusals) {
      const size_t k = static_cast<size_t>(refusal.at.half_step);
      for (size_t i = k > 0 ? k - 1 : 0; i < std::min(n, k + 2); ++i) held[i] = true;
    }
    for (size_t i = 0; i < n; ++i) {
      if (held[i]) lambda[i] *= 0.5;
      if (rules_.local && lambda[i] < kLeastPart) lambda[i] = 0.0;
    }
  }
  return 0.0;
}

}  // namespace halfstep
