#include "smoothing/methods/walk_problem.h"

#include <string>
#include <utility>

#include "smoothing/proof/certified_feasibility.h"
#include "wpg/check.h"

namespace halfstep {

WalkProblem::WalkProblem(RobotModel robot, Scene scene, HalfStepSequence sequence,
                         MarginLimits limits, std::vector<FixedParameter> fixed)
    : WalkProblem(
          std::move(sequence),
          std::make_shared<CertifiedFeasibility>(
              MarginEvaluator(std::move(robot), std::move(scene), limits), CertificationOptions{}),
          std::move(fixed)) {}

WalkProblem::WalkProblem(HalfStepSequence sequence, std::shared_ptr<const FeasibilityTest> test,
                         std::vector<FixedParameter> fixed)
    : sequence_(std::make_shared<HalfStepSequence>(std::move(sequence))),
      test_(std::move(test)),
      fixed_(std::move(fixed)) {
  const std::string complaint = ComplaintAbout(*sequence_, fixed_);
  HALFSTEP_CHECK(complaint.empty(), complaint);
}

}  // namespace halfstep
