#include "smoothing/proof/sampled_feasibility.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wpg/check.h"
#include "wpg/files/plain_locale.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// Instants 0 … n of a span, evenly spaced by at most `period`.
struct Grid {
  Grid(const TimeSpan& span, double period)
      : begin(span.begin),
        n(std::max<long>(1, static_cast<long>(std::ceil((span.end - span.begin) / period - 1e-9)))),
        step((span.end - span.begin) / static_cast<double>(n)) {}
  double at(long i) const { return begin + step * static_cast<double>(i); }

  double begin;
  long n;
  double step;
};

}  // namespace

std::string_view Name(Evidence evidence) {
  return evidence == Evidence::kSampled ? "sampled" : "certified";
}

SampledFeasibility::SampledFeasibility(MarginEvaluator evaluator, double period)
    : evaluator_(std::move(evaluator)), period_(period) {
  HALFSTEP_CHECK(period > 0.0, "period = " << period);
}

std::string SampledFeasibility::Description() const {
  PlainStream out;
  out << "sampled every " << 1e3 * period_ << " ms";
  return out.str();
}

Feasibility SampledFeasibility::Check(const SuperposedWalk& walk, const TimeSpan& span,
                                      MarginEvaluator::Scratch* scratch) const {
  const Grid grid(span, period_);
  // Every 16th instant first, then the ones half-way, and so on: a violation that lasts is met
  // early.
  constexpr long kCoarsest = 16;
  for (long stride = kCoarsest; stride >= 1; stride /= 2) {
    for (long i = 0; i <= grid.n; i += stride) {
      if (stride < kCoarsest && i % (2 * stride) == 0) continue;
      if (scratch->stop.stop_requested()) {
        Margin open{.family = MarginFamily::kClearance, .value = std::nan("")};
        open.t = grid.at(i);
        open.at = walk.Locate(open.t);
        return {Verdict::kUndecided, Evidence::kSampled, open, /*stopped=*/true};
      }
      const auto violation = evaluator_.FirstViolation(walk, walk.Locate(grid.at(i)), scratch);
      if (violation) return {Verdict::kViolated, Evidence::kSampled, *violation};
    }
  }
  return {Verdict::kFeasible, Evidence::kSampled, {}};
}

MarginSet SampleMargins(const MarginEvaluator& evaluator, const SuperposedWalk& walk, double period,
                        MarginEvaluator::Scratch* scratch) {
  const Grid grid({0.0, walk.duration()}, period);
  MarginSet least = evaluator.At(walk, walk.Locate(grid.at(0)), scratch);
  for (long i = 1; i <= grid.n; ++i) {
    const MarginSet here = evaluator.At(walk, walk.Locate(grid.at(i)), scratch);
    for (size_t f = 0; f < here.size(); ++f) {
      if (here[f].value < least[f].value) least[f] = here[f];
    }
  }
  return least;
}

const Margin& WorstOf(const MarginSet& margins, const MarginLimits& limits) {
  // Where a leg does not reach there is no motion, and other margins are −∞ or follow from it.
  const Margin& reach = Nth(margins, MarginFamily::kReach);
  if (reach.value < 0.0) return reach;
  const auto before = [&](const Margin& a, const Margin& b) {
    const double slack_a = limits.Slack(a), slack_b = limits.Slack(b);
    const bool endless_a = slack_a == -kUnlimited, endless_b = slack_b == -kUnlimited;
    if (endless_a && !endless_b) return slack_b >= 0.0;
    if (endless_b && !endless_a) return slack_a < 0.0;
    return slack_a < slack_b;
  };
  const Margin* worst = &margins.front();
  for (const Margin& margin : margins) {
    if (before(margin, *worst)) worst = &margin;
  }
  return *worst;
}

}  // namespace halfstep
