// Plans that are not feasible: too fast, too low, out of reach.

#include "smoothing/methods/plan_repair.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/walk/superposed_walk.h"
#include "tests/scenarios/load_experiment.h"

namespace halfstep {
namespace {

using testing::HasSubstr;

class PlanRepairTest : public testing::Test {
 protected:
  explicit PlanRepairTest(const std::string& name = "bar_8cm") : e_(LoadExperiment(name)) {}

  bool Feasible(const HalfStepSequence& plan) const {
    MarginEvaluator::Scratch scratch = test_.evaluator().MakeScratch();
    const SuperposedWalk walk(plan, PlannedMotion(plan));
    return test_.Check(walk, {0.0, walk.duration()}, &scratch).verdict == Verdict::kFeasible;
  }
  static void SetStep(int step, double duration, double height, HalfStepSequence* plan) {
    for (const int i : {2 * step, 2 * step + 1}) {
      HalfStep& half_step = plan->half_steps[static_cast<size_t>(i)].half_step;
      half_step.duration = duration;
      half_step.via_height = height;
    }
  }

  const Experiment e_;
  const CertifiedFeasibility test_{{e_.robot, e_.scene, e_.config.smoothing.limits}, {}};
};

TEST_F(PlanRepairTest, AFeasiblePlanStaysAsItIs) {
  const PlanRepair repair = RepairPlan(e_.sequence, test_, {}, {});
  EXPECT_TRUE(repair.steps.empty());
  EXPECT_TRUE(repair.failures.empty());
}

TEST_F(PlanRepairTest, AStepTooFastTakesLongerAndNoOtherDoes) {
  HalfStepSequence fast = e_.sequence;
  SetStep(1, 1.2, 0.25, &fast);
  ASSERT_FALSE(Feasible(fast));
  const PlanRepair repair = RepairPlan(fast, test_, {}, {});
  ASSERT_TRUE(repair.failures.empty()) << repair.failures.front();
  ASSERT_EQ(repair.steps.size(), 1u);
  EXPECT_EQ(repair.steps[0].step, 1);
  EXPECT_GT(*repair.steps[0].duration, 1.2);
  EXPECT_LT(*repair.steps[0].duration, 2.1);
  EXPECT_TRUE(Feasible(repair.sequence));
  HalfStepSequence shorter = repair.sequence;  // it takes no longer than it must
  SetStep(1, 0.97 * *repair.steps[0].duration, *repair.steps[0].via_height, &shorter);
  EXPECT_FALSE(Feasible(shorter));
}

TEST_F(PlanRepairTest, AStepTooLowOverTheBarGoesHigher) {
  HalfStepSequence low = e_.sequence;
  SetStep(0, 2.0, 0.15, &low);
  ASSERT_FALSE(Feasible(low));
  const PlanRepair repair = RepairPlan(low, test_, {}, {});
  ASSERT_TRUE(repair.failures.empty()) << repair.failures.front();
  ASSERT_EQ(repair.steps.size(), 1u);
  EXPECT_EQ(repair.steps[0].step, 0);
  EXPECT_GT(*repair.steps[0].via_height, 0.15);
  EXPECT_TRUE(Feasible(repair.sequence));
}

TEST_F(PlanRepairTest, AFootstepOutOfReachCannotBeMadeAtAll) {
  const Foothold left = Foothold::Level({0.0, 0.085, 0.0});
  const Foothold right = Foothold::Level({0.0, -0.085, 0.0});
  const HalfStepSequence far = MakeSequence(
      {left, right}, {{.side = Side::kRight, .X_WF = Foothold::Level({1.0, -0.085, 0.0})}}, 0.24,
      e_.sequence.half_steps[0].half_step.shape, e_.sequence.model);
  const PlanRepair repair = RepairPlan(far, test_, {}, {});
  EXPECT_TRUE(repair.steps.empty());
  ASSERT_EQ(repair.failures.size(), 1u);
  EXPECT_THAT(repair.failures[0],
              HasSubstr("footstep 1 cannot be made at any duration and height: reach of"));
}

TEST_F(PlanRepairTest, WhatIsNotFoundIsNotCalledImpossible) {
  HalfStepSequence fast = e_.sequence;
  SetStep(1, 0.7, 0.25, &fast);
  const PlanRepair repair = RepairPlan(fast, test_, {.most_duration = 0.75}, {});
  ASSERT_EQ(repair.failures.size(), 1u);
  EXPECT_THAT(repair.failures[0], HasSubstr("footstep 2: nothing was found up to 0.75 s"));
  EXPECT_THAT(repair.failures[0], testing::Not(HasSubstr("cannot")));
  std::stop_source source;
  source.request_stop();
  EXPECT_TRUE(RepairPlan(fast, test_, {}, source.get_token()).stopped);
}

}  // namespace
}  // namespace halfstep
