#pragma once

#include <stop_token>
#include <string>

#include "smoothing/proof/feasibility_test.h"

namespace halfstep {

/// Checks margins at instants no more than `period` apart, both ends of the span included, widely
/// spaced ones first. Feasible means that margins are kept at these instants; it says nothing about
/// the motion between them.
class SampledFeasibility : public FeasibilityTest {
 public:
  /// `period` [s] > 0 (std::logic_error).
  SampledFeasibility(MarginEvaluator evaluator, double period);

  Evidence evidence() const override { return Evidence::kSampled; }  ///< always kSampled
  std::string Description() const override;
  const MarginEvaluator& evaluator() const override { return evaluator_; }  ///< as given
  std::unique_ptr<FeasibilityTest> Over(const MarginEvaluator& evaluator) const override {
    return std::make_unique<SampledFeasibility>(evaluator, period_);
  }
  Feasibility Check(const SuperposedWalk& walk, const TimeSpan& span,
                    MarginEvaluator::Scratch* scratch) const override;

 private:
  MarginEvaluator evaluator_;
  double period_;
};

/// The smallest value of each margin at instants no more than `period` [s] apart over the whole
/// walk, both ends included. It is slower than Check, which needs verdicts only.
MarginSet SampleMargins(const MarginEvaluator& evaluator, const SuperposedWalk& walk, double period,
                        MarginEvaluator::Scratch* scratch);

/// The margin with the least slack (MarginLimits::Slack), or `reach` where a leg does not reach.
/// Where some are −∞, of which nothing can be told, a finite one that is missed comes before them.
const Margin& WorstOf(const MarginSet& margins, const MarginLimits& limits);

}  // namespace halfstep
