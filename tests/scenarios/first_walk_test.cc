// Walks of robots that cannot make their half-steps one after the other.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/overlap_optimizer.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/scenarios/load_experiment.h"
#include "tests/smoothing/fake_feasibility.h"
#include "tests/smoothing/smoothed.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {
namespace {

using testing::HasSubstr;

class FirstWalkTest : public testing::Test {
 protected:
  // HRP-2 whose hips roll with this share of the torque that its half-steps take one after the
  // other; other joints are as strong as one likes.
  Experiment WithHips(double share) const {
    constexpr double kMuch = 1e4;  // [N m]
    const auto with = [this](double torque) {
      Experiment weak = e_;
      for (Leg& leg : weak.robot.legs) {
        for (LegJoint& joint : leg.joints) joint.max_torque = kMuch;
        leg.joints[1].max_torque = torque;
      }
      return weak;
    };
    const Experiment strong = with(kMuch / 10);
    const MarginEvaluator evaluator(strong.robot, strong.scene, MarginLimits{});
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    const SuperposedWalk walk(strong.sequence, PlannedMotion(strong.sequence));
    double taken = 0.0;
    for (double t = 0.0; t < walk.duration(); t += 0.01) {
      const MarginSet margins = evaluator.At(walk, walk.Locate(t), &scratch);
      taken = std::max(taken, kMuch / 10 - Of(margins, MarginFamily::kTorque).value);
    }
    return with(share * taken);
  }

  static OptimizerOptions Options(double effort) {
    OptimizerOptions options;
    options.solver = "halfstep/sqp";
    options.program.parameters = EveryFamily();
    options.effort = effort;
    return options;
  }

  const Experiment e_ = LoadExperiment("fig3_two_half_steps");
};

TEST_F(FirstWalkTest, IsFoundWhereTheRobotCannotRestOnOneFoot) {
  const Experiment weak = WithHips(0.9);
  const MarginEvaluator evaluator(weak.robot, weak.scene, MarginLimits{});
  const CertifiedFeasibility test(evaluator, {});
  const WalkProblem problem = ProblemOf(weak.sequence, test);
  const SmoothingResult dichotomy = Smoothed(Dichotomy, problem, {.tolerance = 0.01});
  EXPECT_EQ(dichotomy.ending, opt::Ending::kNotRun);
  EXPECT_THAT(dichotomy.message, HasSubstr("the planned motion is not feasible"));
  EXPECT_FALSE(dichotomy.feasible);
  const SmoothingResult found = Smoothed(OptimizeOverlaps, problem, Options(4.0));
  EXPECT_TRUE(found.feasible) << found.message;
  const SuperposedWalk walk(weak.sequence, found.parameters);
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  EXPECT_EQ(test.Check(walk, {0.0, walk.duration()}, &scratch).verdict, Verdict::kFeasible);
}

TEST_F(FirstWalkTest, IsNotClaimedWhereThereIsNone) {
  const Experiment weak = WithHips(0.05);
  const MarginEvaluator evaluator(weak.robot, weak.scene, MarginLimits{});
  const CertifiedFeasibility test(evaluator, {});
  const SmoothingResult found =
      Smoothed(OptimizeOverlaps, ProblemOf(weak.sequence, test), Options(0.5));
  EXPECT_FALSE(found.feasible);
  EXPECT_EQ(found.ending, opt::Ending::kNoImprovement);
  EXPECT_EQ(found.parameters, ProblemOf(weak.sequence, test).Start());
  EXPECT_THAT(found.message, HasSubstr("no walk was proved either, "));
}

}  // namespace
}  // namespace halfstep
