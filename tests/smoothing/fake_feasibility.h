#pragma once

#include <functional>
#include <string>
#include <vector>

#include "smoothing/proof/feasibility_test.h"
#include "smoothing/walk/homotopy_parameters.h"

namespace halfstep {

/// Answers by a rule on the homotopy parameters instead of the motion, and remembers what it was
/// asked.
class FakeFeasibility : public FeasibilityTest {
 public:
  using Rule = std::function<Verdict(const HomotopyParameters&)>;
  struct Question {
    HomotopyParameters parameters;
    TimeSpan span;
    Verdict verdict;
  };

  FakeFeasibility(const MarginEvaluator& evaluator, Rule rule)
      : evaluator_(evaluator), rule_(std::move(rule)) {}

  Evidence evidence() const override { return Evidence::kCertified; }
  std::string Description() const override { return "fake"; }
  const MarginEvaluator& evaluator() const override { return evaluator_; }
  std::unique_ptr<FeasibilityTest> Over(const MarginEvaluator& evaluator) const override {
    return std::make_unique<FakeFeasibility>(evaluator, rule_);
  }
  Feasibility Check(const SuperposedWalk& walk, const TimeSpan& span,
                    MarginEvaluator::Scratch* scratch) const override {
    ++scratch->work.instants;
    const Verdict verdict = rule_(walk.parameters());
    questions.push_back({walk.parameters(), span, verdict});
    Margin witness{.family = MarginFamily::kZmp, .value = -0.02};
    witness.t = static_cast<double>(questions.size());  // to tell witnesses apart
    return {verdict, Evidence::kCertified, witness};
  }

  mutable std::vector<Question> questions;

 private:
  const MarginEvaluator& evaluator_;
  Rule rule_;
};

}  // namespace halfstep
