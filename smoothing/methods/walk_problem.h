#pragma once

#include <memory>
#include <vector>

#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/proof/feasibility_test.h"
#include "smoothing/walk/parameter_table.h"
#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

/// A walk to be smoothed: the robot, the scene, the planned half-steps, what is demanded of the
/// motion, how candidates are judged, and the parameters that must stay. A value: copies are cheap
/// (robot and scene are shared) and immutable.
class WalkProblem {
 public:
  /// Candidates are certified with the default options.
  WalkProblem(RobotModel robot, Scene scene, HalfStepSequence sequence, MarginLimits limits,
              std::vector<FixedParameter> fixed = {});
  /// Robot, scene and limits are those of the test. Both constructors throw std::logic_error when
  /// ComplaintAbout() complains about `fixed`, or when the ground bears no sole where one is
  /// planned.
  WalkProblem(HalfStepSequence sequence, std::shared_ptr<const FeasibilityTest> test,
              std::vector<FixedParameter> fixed = {});

  const HalfStepSequence& sequence() const { return *sequence_; }  ///< the half-steps, as planned
  const RobotModel& robot() const { return evaluator().robot(); }  ///< the robot that walks
  const Scene& scene() const { return evaluator().scene(); }       ///< where it walks
  const MarginLimits& limits() const { return evaluator().limits(); }  ///< demanded margins as well
  const MarginEvaluator& evaluator() const { return test_->evaluator(); }  ///< of all margins
  const FeasibilityTest& test() const { return *test_; }  ///< how walks are accepted
  /// Parameters that methods must leave alone.
  const std::vector<FixedParameter>& fixed() const { return fixed_; }

  /// Every parameter, with the range within which a method may move it when it searches `choice`.
  ParameterTable Parameters(const ParameterChoice& choice = {}) const {
    return ParameterTable(*sequence_, fixed_, choice);
  }
  /// Where methods begin: the planned motion, but with fixed parameters at their values.
  HomotopyParameters Start() const { return Parameters().Start(); }

 private:
  std::shared_ptr<const HalfStepSequence> sequence_;
  std::shared_ptr<const FeasibilityTest> test_;
  std::vector<FixedParameter> fixed_;
};

}  // namespace halfstep
