#pragma once

#include <memory>
#include <string>

#include "smoothing/proof/feasibility_test.h"

namespace halfstep {

/// Demands of a walk what another test demands, and the same of its stop branches: that at any time
/// the robot may begin nothing more and come to rest with every margin kept. Of the branch after
/// half-step k only [t_{k+1}, e_k] is checked, since it is the walk itself before; a check of a
/// span includes the branches whose t_{k+1} lies in it, both ends included. So walks whose
/// spans were checked one after the other have been checked as a whole.
/// Source: smoothing/README.md, "Stop branches".
class StoppableFeasibility : public FeasibilityTest {
 public:
  /// `test` decides about the walk and about each stop branch that is demanded.
  StoppableFeasibility(std::shared_ptr<const FeasibilityTest> test, StopBranches branches);

  Evidence evidence() const override { return test_->evidence(); }  ///< that of the test
  std::string Description() const override;
  /// That of the test.
  const MarginEvaluator& evaluator() const override { return test_->evaluator(); }
  StopBranches stop_branches() const override { return branches_; }
  std::unique_ptr<FeasibilityTest> Over(const MarginEvaluator& evaluator) const override;
  /// The witness says whether it is of a branch (Margin::stop_after).
  Feasibility Check(const SuperposedWalk& walk, const TimeSpan& span,
                    MarginEvaluator::Scratch* scratch) const override;
  /// The same of the branches alone, for a walk that the test is known to accept itself.
  Feasibility CheckBranches(const SuperposedWalk& walk, const TimeSpan& span,
                            MarginEvaluator::Scratch* scratch) const;

 private:
  std::shared_ptr<const FeasibilityTest> test_;
  StopBranches branches_;
};

}  // namespace halfstep
