#include "smoothing/proof/missed_demands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "smoothing/proof/certified_feasibility.h"
#include "tests/wpg/hrp2.h"
#include "tests/wpg/one_step.h"
#include "wpg/motion/lipm.h"

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
    const HalfStepSequence sequence = OneStep(robot_);
    return {sequence, PlannedMotion(sequence)};
  }
  // Footsteps of both feet in turn, the right one first, `apart` [m] ahead of each other, but for
  // that after step `long_after`, which is `length` ahead.
  HalfStepSequence StepsAhead(int count, double apart, double length, int long_after = -1) const {
    const double y = 0.085;
    std::vector<Footstep> footsteps;
    double x = 0.0;
    for (int i = 0; i < count; ++i) {
      x += i == long_after ? length : apart;
      const Side side = i % 2 == 0 ? Side::kRight : Side::kLeft;
      footsteps.push_back({.side = side,
                           .X_WF = Foothold::Level({x, side == Side::kLeft ? y : -y, 0}),
                           .via_height = 0.25,
                           .duration = 2.0});
    }
    return MakeSequence({Foothold::Level({0, y, 0}), Foothold::Level({0, -y, 0})}, footsteps, 0.24,
                        {}, std::make_shared<Lipm>(robot_.com_height));
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
    EXPECT_GE(limits_.Slack(demand.worst), slack - 1e-3)
        << "worst first, but for what differs by less than a thousandth, which is by time";
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

// Eight steps ahead; the right foot of the fifth one stands 1 mm in a plank beside it, and so the
// margin is the same at every instant while it stands there, but for rounding.
TEST_F(MissedDemandsTest, AFootThatStandsInTheWayIsBlamedOnTheStepThatPutItThere) {
  const HalfStepSequence sequence = StepsAhead(8, 0.1, 0.1);
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  const double edge = 0.12 - 0.002;  // of the foot at its side, 1 mm inside of it
  Scene scene;
  scene.obstacles.push_back({.name = "plank", .shape = Box{{0.05, 0.1, 0.02}}});
  scene.obstacles[0].X_WO = ToIsometry(Pose2{0.5, -0.085 - edge, 0}, 0.01);
  const MarginEvaluator evaluator(robot_, scene, limits_);
  const MissedDemands missed = FindMissedDemands(evaluator, walk, WitnessOf(evaluator, walk));
  ASSERT_FALSE(missed.demands.empty());
  const MissedDemand& plank = missed.demands.front();
  EXPECT_EQ(plank.worst.family, MarginFamily::kClearance);
  EXPECT_NEAR(plank.worst.value, -0.001, 2e-4);
  EXPECT_EQ(plank.footstep, 4);
  EXPECT_LT(plank.worst.t, walk.end_of(9)) << "before it stands, or as soon as it does";
  EXPECT_GT(plank.worst.t, walk.start_of(9));
  EXPECT_GT(plank.instants, missed.instants / 10) << "it stands there for long";
}

// Of a foot that stands where it began nobody but the start is to blame.
TEST_F(MissedDemandsTest, AFootThatStartsInTheWayIsBlamedOnNoFootstep) {
  const HalfStepSequence sequence = StepsAhead(3, 0.1, 0.1);
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  Scene scene;
  // So thin that the foot is above it before it moves aside.
  scene.obstacles.push_back({.name = "plank", .shape = Box{{0.05, 0.1, 0.004}}});
  scene.obstacles[0].X_WO = ToIsometry(Pose2{0.0, 0.085 + 0.118, 0}, 0.002);
  const MarginEvaluator evaluator(robot_, scene, limits_);
  const MissedDemands missed = FindMissedDemands(evaluator, walk, WitnessOf(evaluator, walk));
  ASSERT_FALSE(missed.demands.empty());
  EXPECT_EQ(missed.demands.front().footstep, -1);
  EXPECT_TRUE(missed.demands.front().stands);
  EXPECT_EQ(missed.demands.front().worst.t, 0.0);
}

// In a walk of 48 s the instants that all families are looked at are 160 ms apart, and a leg that
// does not reach for less than that lies between two of them.
TEST_F(MissedDemandsTest, ALegThatDoesNotReachForAMomentIsAmongThem) {
  const int step = 6;
  for (double length = 0.1; length < 0.6; length += 0.001) {
    const HalfStepSequence sequence = StepsAhead(12, 0.05, length, step);
    const SuperposedWalk walk(sequence, PlannedMotion(sequence));
    double least = 0.0;
    int instants = 0;
    for (double t = walk.start_of(2 * step); t < walk.end_of(2 * step + 3); t += 5e-3) {
      const Posture posture = SolvePosture(robot_, walk.At(walk.Locate(t)).value);
      const double reach = std::min(posture.ik[0].reach_margin, posture.ik[1].reach_margin);
      least = std::min(least, reach);
      instants += reach < 0.0;
    }
    if (instants < 4) continue;
    ASSERT_LT(instants, 30) << "it does not reach for 20 to 150 ms";
    const Margin witness{.family = MarginFamily::kZmp, .value = 0.00999, .subject = 0};
    const MissedDemands missed = FindMissedDemands(Evaluator(), walk, witness);
    const auto reach = std::ranges::find_if(missed.demands, [](const MissedDemand& demand) {
      return demand.worst.family == MarginFamily::kReach;
    });
    ASSERT_NE(reach, missed.demands.end()) << length;
    EXPECT_LE(reach->worst.value, least + 1e-9);
    EXPECT_EQ(missed.demands.front().worst.family, MarginFamily::kReach)
        << "what it causes follows";
    return;
  }
  FAIL() << "no step is too long";
}

}  // namespace
}  // namespace halfstep
