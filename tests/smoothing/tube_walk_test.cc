// Motions within a tube around a certified walk keep what is demanded; those of a wider one do not.
//
// A few thousand motions; HALFSTEP_TUBE=10000 for that many.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "smoothing/margins/demandable.h"
#include "smoothing/margins/family_traits.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/smoothing/short_walks.h"
#include "tests/smoothing/test_scenes.h"
#include "tests/smoothing/tube_cases.h"
#include "tests/smoothing/tube_draw.h"
#include "tests/smoothing/tube_margins.h"

namespace halfstep {
namespace {

// A walk that is as near to its limits as a tube lets it be, in every family that holds in a tube.
class NarrowTube {
 public:
  // Certificates take `parts` of the tube that motions have.
  NarrowTube(const Tube& tube, double parts)
      : tube_(tube), sequence_(TwoSteps(robot_)), walk_(sequence_, PlannedMotion(sequence_)) {
    limits_.tube = {.foot = parts * tube.foot,
                    .foot_turn = parts * tube.foot_turn,
                    .waist = parts * tube.waist,
                    .waist_turn = parts * tube.waist_turn,
                    .joint = parts * tube.joint,
                    .joint_speed = parts * tube.joint_speed,
                    .zmp = parts * tube.zmp};
    const MarginEvaluator evaluator(robot_, scene_, limits_);
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    least_ = evaluator.At(walk_, walk_.Locate(0.0), &scratch);
    for (double t = 0.0; t <= walk_.duration(); t += 0.001) {
      const MarginSet now = evaluator.At(walk_, walk_.Locate(t), &scratch);
      for (size_t f = 0; f < now.size(); ++f) {
        if (now[f].value < least_[f].value) least_[f] = now[f];
      }
    }
    // Demands just what the walk has, and nothing of other families.
    limits_.demanded.fill(-100.0);
    limits_.demanded_of(MarginFamily::kFriction) = kNotDemanded;
    for (const MarginFamily family : AllMarginFamilies()) {
      if (Traits(family).in_tube == nullptr) continue;
      // What is between samples; that of soles, ZMP and speeds changes fast.
      const bool fast = family == MarginFamily::kFloor || family == MarginFamily::kZmpRobot ||
                        family == MarginFamily::kJointSpeed;
      limits_.demanded_of(family) = Nth(least_, family).value -
                                    Nth(RaisedBy(limits_.tube, robot_), family) -
                                    (fast ? 5e-3 : 2e-4);
    }
  }

  // The verdict with these demands, in the tube that motions have or in that of the certificates.
  Feasibility Certified(bool in_all) const {
    MarginLimits limits = limits_;
    if (in_all) limits.tube = tube_;
    Certificate rows;
    return Certify(robot_, scene_, limits, walk_, &rows);
  }
  // How many of `motions` drawn ones have a margin below what is asked, by family; half of them
  // where one of the families is nearest to its limit.
  std::map<MarginFamily, int> Beyond(int motions) const {
    const MarginEvaluator evaluator(robot_, scene_, {});
    TubeDraw draw(robot_, tube_, 3);
    std::map<MarginFamily, int> beyond;
    for (int i = 0; i < motions; ++i) {
      const double anywhere = draw.draw().Uniform(0, walk_.duration());
      const Margin& nearest = least_[static_cast<size_t>(i / 2) % least_.size()];
      const LocalTime at = walk_.Locate(i % 2 == 0 ? anywhere : nearest.t);
      const Posture plan = SolvePosture(robot_, walk_.At(at).value);
      for (const auto& [family, margin] : TubeMarginsOf(evaluator, draw.Near(plan), walk_, at)) {
        if (margin < Nth(limits_.demanded, family)) ++beyond[family];
      }
    }
    return beyond;
  }

 private:
  Tube tube_;
  RobotModel robot_ = Hrp2();
  HalfStepSequence sequence_;
  SuperposedWalk walk_;
  Scene scene_ = NarrowScene(robot_, 0.05);
  MarginLimits limits_;
  MarginSet least_;
};

TEST(Tube, EveryMotionWithinTheTubeOfACertifiedWalkKeepsWhatIsDemanded) {
  const NarrowTube narrow(SomeTube(1.0), 1.0);
  const Feasibility answer = narrow.Certified(true);
  ASSERT_EQ(answer.verdict, Verdict::kFeasible) << Name(answer.witness.family);
  EXPECT_THAT(narrow.Beyond(Motions(2000)), testing::IsEmpty());
}

// A walk that is certified in a tube half as wide is refused in all of it, and motions in all of it
// miss what is demanded.
TEST(Tube, OfHalfTheWidthIsNotEnough) {
  const NarrowTube narrow(SomeTube(1.0), 0.5);
  const Feasibility answer = narrow.Certified(false);
  EXPECT_EQ(answer.verdict, Verdict::kFeasible) << Name(answer.witness.family);
  EXPECT_EQ(narrow.Certified(true).verdict, Verdict::kViolated);
  const auto beyond = narrow.Beyond(Motions(2000));
  EXPECT_TRUE(beyond.contains(MarginFamily::kJoint));
  EXPECT_TRUE(beyond.contains(MarginFamily::kNoStep));
}

// The same of a tenth, for what few of the drawn motions do to the full.
TEST(Tube, OfATenthOfTheWidthIsNotEnoughForBodies) {
  const auto beyond = NarrowTube(SomeTube(1.0), 0.1).Beyond(Motions(2000));
  EXPECT_TRUE(beyond.contains(MarginFamily::kClearance));
  EXPECT_TRUE(beyond.contains(MarginFamily::kGround));
}

}  // namespace
}  // namespace halfstep
