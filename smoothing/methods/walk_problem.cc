#include "smoothing/methods/walk_problem.h"

#include <cmath>
#include <string>
#include <utility>

#include "smoothing/proof/certified_feasibility.h"
#include "wpg/check.h"

namespace halfstep {
namespace {

void CheckBorne(const Ground& ground, const Eigen::Matrix2Xd& outline, const Foothold& X_WF) {
  constexpr double kSame = 0.5e-9;  // [m] heights of one level differ by less, by different sums
  const auto stands = ground.Standing(outline, X_WF.Planar(), X_WF.height + kSame);
  HALFSTEP_CHECK(stands && std::abs(stands->height - X_WF.height) < kSame,
                 "no level under a sole at " << X_WF.x << ", " << X_WF.y << ", " << X_WF.height);
}

}  // namespace

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
  for (const auto& [half_step, X_WS, rest] : sequence_->half_steps) {
    CheckBorne(*scene().ground, robot().sole_outline, X_WS);
    CheckBorne(*scene().ground, robot().sole_outline, X_WS * half_step.X_SF);
  }
}

}  // namespace halfstep
