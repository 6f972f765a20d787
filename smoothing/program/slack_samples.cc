#include "smoothing/program/slack_samples.h"

#include <algorithm>
#include <cmath>

#include "wpg/nth.h"

namespace halfstep {

std::vector<LeastSlacks> SampledSlacks(const SuperposedWalk& walk, const MarginEvaluator& evaluator,
                                       const StretchRange& range, const SampleOptions& options,
                                       Workers* workers, Work* work) {
  constexpr int kAtOnce = 8;  // samples that a thread takes
  const int n = static_cast<int>(std::ceil((walk.duration() - options.begin) / options.period));
  std::vector<LeastSlacks> samples(static_cast<size_t>(n) + 1);
  std::vector<SlackEvaluator> slacks(static_cast<size_t>(NumThreads(workers)),
                                     SlackEvaluator(evaluator, options.cutoff));
  RunWith(workers, n / kAtOnce + 1, [&](int part, int thread) {
    InstantSlacks instant;
    for (int i = part * kAtOnce; i <= std::min(n, part * kAtOnce + kAtOnce - 1); ++i) {
      LeastSlacks& sample = Nth(samples, i);
      sample.fill(options.cutoff);
      const double t = std::min(options.begin + i * options.period, walk.duration());
      const LocalTime at = walk.Locate(t);
      if (!range.contains(at.half_step)) continue;
      Nth(slacks, thread).At(walk, at, {}, false, &instant);
      for (const SlackRow& row : instant.rows) {
        double& least = Nth(sample, row.family);
        least = std::min(least, row.slack);
      }
    }
    return true;
  });
  for (const SlackEvaluator& of_thread : slacks) {
    if (work != nullptr) *work += of_thread.work();
  }
  return samples;
}

double LocalMinimum(const std::vector<LeastSlacks>& samples, int i, double otherwise) {
  double lowest = otherwise;
  for (size_t f = 0; f < kNumMarginFamilies; ++f) {
    const double slack = Nth(samples, i)[f];
    const bool falls = i == 0 || slack < Nth(samples, i - 1)[f];
    const bool rises = i + 1 == std::ssize(samples) || slack <= Nth(samples, i + 1)[f];
    if (falls && rises) lowest = std::min(lowest, slack);
  }
  return lowest;
}

}  // namespace halfstep
