#include "smoothing/proof/missed_demands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "smoothing/proof/certified_feasibility.h"
#include "tests/wpg/hrp2.h"

namespace halfstep {
namespace {

// A step ahead of HRP-2, some of whose bodies are larger than they are.
class MissedDemandsTest : public testing::Test {
 protected:
  // Bodies whose names hold `part` grow by `radius` [m].
  void Inflate(const std::string& part, double radius) {
    for (RobotBody& body : robot_.bodies) {
      if (body.name.find(part) == std::string::npos) continue;
      body.shape.ball_radius += radius;
      BoundBySphere(&body.shape);
    }
  }
  MarginEvaluator Evaluator() const { return {robot_, {}, limits_}; }
  SuperposedWalk Walk() const {
    const double y = 0.5 * robot_.standing_width;
    const HalfStepSequence sequence = MakeSequence(
        {Pose2{0, y, 0}, Pose2{0, -y, 0}},
        {{.side = Side::kLeft, .X_WF = {0.2, y, 0}, .via_height = 0.25, .duration = 2.0}}, 0.24, {},
        {.com_height = robot_.com_height});
    return {sequence, PlannedMotion(sequence)};
  }
  static Margin WitnessOf(const MarginEvaluator& evaluator, const SuperposedWalk& walk) {
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    const Feasibility answer =
        CertifiedFeasibility(evaluator, {}).Check(walk, {0.0, walk.duration()}, &scratch);
    EXPECT_EQ(answer.verdict, Verdict::kViolated);
    return answer.witness;
  }

  RobotModel robot_ = Hrp2();
  MarginLimits limits_;
};

TEST_F(MissedDemandsTest, TellsEveryPairThatTouchesAtItsWorstInstantTheWorstFirst) {
  Inflate("LEG_LINK2", 0.06);
  Inflate("LEG_LINK4", 0.03);
  const MarginEvaluator evaluator = Evaluator();
  const SuperposedWalk walk = Walk();
  const double demanded = limits_.demanded_of(MarginFamily::kSelfClearance);
  // The least of each pair, every millisecond.
  std::map<std::array<int, 2>, double> least;
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  for (double t = 0.0; t <= walk.duration(); t += 1e-3) {
    const Posture posture = SolvePosture(evaluator.robot(), walk.At(walk.Locate(t)).value);
    evaluator.clearances().Place(posture, &scratch.bodies);
    for (size_t p = 0; p < evaluator.clearances().num_pairs(); ++p) {
      const Margin margin = evaluator.clearances().OfPair(p, posture, demanded, &scratch.bodies);
      if (margin.value >= demanded) continue;
      double& known = least.try_emplace({margin.subject, margin.other}, demanded).first->second;
      known = std::min(known, margin.value);
    }
  }
  ASSERT_GE(least.size(), 3u);

  const Margin witness = WitnessOf(evaluator, walk);
  const MissedDemands missed = FindMissedDemands(evaluator, walk, witness);
  double slack = -std::numeric_limits<double>::infinity();
  size_t pairs = 0;
  for (const MissedDemand& demand : missed.demands) {
    EXPECT_GE(limits_.Slack(demand.worst), slack) << "worst first";
    slack = limits_.Slack(demand.worst);
    if (demand.worst.family != MarginFamily::kSelfClearance) continue;
    ++pairs;
    EXPECT_GE(demand.instants, 1);
    const auto known = least.find({demand.worst.subject, demand.worst.other});
    ASSERT_NE(known, least.end());
    EXPECT_NEAR(demand.worst.value, known->second, 2e-4);
    // What is told is so at the instant that is told.
    const Posture posture = SolvePosture(evaluator.robot(), walk.At(demand.worst.at).value);
    evaluator.clearances().Place(posture, &scratch.bodies);
    bool found = false;
    for (size_t p = 0; p < evaluator.clearances().num_pairs(); ++p) {
      const Margin margin = evaluator.clearances().OfPair(p, posture, demanded, &scratch.bodies);
      found = found || (margin.subject == demand.worst.subject &&
                        margin.other == demand.worst.other && margin.value == demand.worst.value);
    }
    EXPECT_TRUE(found);
  }
  EXPECT_EQ(pairs, least.size());
  EXPECT_LT(missed.demands.front().worst.value, witness.value)
      << "the first witness is not the worst";
}

TEST_F(MissedDemandsTest, ALegThatDoesNotReachIsSaidOnceAndByHowMuch) {
  robot_.waist_height += 0.05;
  const MarginEvaluator evaluator = Evaluator();
  const SuperposedWalk walk = Walk();
  const MissedDemands missed = FindMissedDemands(evaluator, walk, WitnessOf(evaluator, walk));
  ASSERT_FALSE(missed.demands.empty());
  int reach = 0;
  for (const MissedDemand& demand : missed.demands) {
    reach += demand.worst.family == MarginFamily::kReach;
    // Where a leg is nearly stretched, the floor may not push.
    if (demand.worst.family == MarginFamily::kZmpRobot ||
        demand.worst.family == MarginFamily::kFriction) {
      continue;
    }
    EXPECT_TRUE(std::isfinite(demand.worst.value)) << evaluator.Describe(demand.worst);
  }
  EXPECT_GE(reach, 1);
}

TEST_F(MissedDemandsTest, AWitnessBetweenTheInstantsIsToldAllTheSame) {
  const MarginEvaluator evaluator = Evaluator();
  const Margin witness{.family = MarginFamily::kZmp, .value = 0.00999, .subject = 0};
  const MissedDemands missed = FindMissedDemands(evaluator, Walk(), witness);
  ASSERT_EQ(missed.demands.size(), 1u);
  EXPECT_EQ(missed.demands.front().worst.value, witness.value);
  EXPECT_EQ(missed.demands.front().instants, 0);
}

}  // namespace
}  // namespace halfstep
