#include "smoothing/program/slack_samples.h"

#include <algorithm>
#include <cmath>

namespace halfstep {

std::vector<LeastSlacks> SampledSlacks(const SuperposedWalk& walk, const MarginEvaluator& evaluator,
                                       const StretchRange& range, double begin, double period,
                                       double cutoff) {
  SlackEvaluator slacks(evaluator, cutoff);
  InstantSlacks instant;
  const int n = static_cast<int>(std::ceil((walk.duration() - begin) / period));
  std::vector<LeastSlacks> samples(static_cast<size_t>(n) + 1);
  for (int i = 0; i <= n; ++i) {
    LeastSlacks& sample = samples[static_cast<size_t>(i)];
    sample.fill(cutoff);
    const LocalTime at = walk.Locate(std::min(begin + i * period, walk.duration()));
    if (!range.contains(at.half_step)) continue;
    slacks.At(walk, at, {}, false, &instant);
    for (const SlackRow& row : instant.rows) {
      double& least = sample[static_cast<size_t>(row.family)];
      least = std::min(least, row.slack);
    }
  }
  return samples;
}

double LocalMinimum(const std::vector<LeastSlacks>& samples, int i, double otherwise) {
  const size_t at = static_cast<size_t>(i);
  double lowest = otherwise;
  for (size_t f = 0; f < kNumMarginFamilies; ++f) {
    const double slack = samples[at][f];
    const bool falls = i == 0 || slack < samples[at - 1][f];
    const bool rises = at + 1 == samples.size() || slack <= samples[at + 1][f];
    if (falls && rises) lowest = std::min(lowest, slack);
  }
  return lowest;
}

}  // namespace halfstep
