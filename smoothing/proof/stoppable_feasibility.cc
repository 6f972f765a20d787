#include "smoothing/proof/stoppable_feasibility.h"

#include <utility>

namespace halfstep {

StoppableFeasibility::StoppableFeasibility(std::shared_ptr<const FeasibilityTest> test,
                                           StopBranches branches)
    : test_(std::move(test)), branches_(branches) {}

std::string StoppableFeasibility::Description() const {
  switch (branches_) {
    case StopBranches::kNone:
      return test_->Description();
    case StopBranches::kDown:
      return test_->Description() + "; so is every stop branch after a down half-step";
    case StopBranches::kAll:
      return test_->Description() + "; so is every stop branch";
  }
  return "";
}

std::unique_ptr<FeasibilityTest> StoppableFeasibility::Over(
    const MarginEvaluator& evaluator) const {
  return std::make_unique<StoppableFeasibility>(test_->Over(evaluator), branches_);
}

Feasibility StoppableFeasibility::Check(const SuperposedWalk& walk, const TimeSpan& span,
                                        MarginEvaluator::Scratch* scratch) const {
  const Feasibility answer = test_->Check(walk, span, scratch);
  return answer.verdict == Verdict::kFeasible ? CheckBranches(walk, span, scratch) : answer;
}

Feasibility StoppableFeasibility::CheckBranches(const SuperposedWalk& walk, const TimeSpan& span,
                                                MarginEvaluator::Scratch* scratch) const {
  Feasibility answer{.verdict = Verdict::kFeasible, .evidence = evidence(), .witness = {}};
  for (int k = 0; k + 1 < walk.num_half_steps(); ++k) {
    if (answer.verdict != Verdict::kFeasible) return answer;
    if (!Demands(branches_, walk.half_step(k).kind)) continue;
    const TimeSpan rest{walk.start_of(k + 1), walk.end_of(k)};
    if (rest.begin < span.begin || rest.begin > span.end || rest.end <= rest.begin) continue;
    answer = test_->Check(walk.StopBranch(k), rest, scratch);
    answer.witness.stop_after = k;
  }
  return answer;
}

}  // namespace halfstep
