#include "smoothing/proof/missed_demands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "experiments/run/missed_demands_text.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/scenarios/load_experiment.h"

namespace halfstep {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class MissedDemandsTest : public testing::Test {
 protected:
  // Bodies whose names hold `part` grow by `radius` [m].
  void Inflate(const std::string& part, double radius) {
    for (RobotBody& body : experiment_.robot.bodies) {
      if (body.name.find(part) == std::string::npos) continue;
      body.shape.ball_radius += radius;
      BoundBySphere(&body.shape);
    }
  }
  MarginEvaluator Evaluator() const { return {experiment_.robot, experiment_.scene, limits_}; }
  SuperposedWalk Walk() const {
    return {experiment_.sequence, PlannedMotion(experiment_.sequence)};
  }
  static Margin WitnessOf(const MarginEvaluator& evaluator, const SuperposedWalk& walk) {
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    const Feasibility answer =
        CertifiedFeasibility(evaluator, {}).Check(walk, {0.0, walk.duration()}, &scratch);
    EXPECT_EQ(answer.verdict, Verdict::kViolated);
    return answer.witness;
  }

  Experiment experiment_ = LoadExperiment("fig3_two_half_steps");
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

TEST_F(MissedDemandsTest, SaysWhatHelps) {
  Inflate("LEG_LINK2", 0.06);
  limits_.demanded_of(MarginFamily::kZmp) = 0.08;
  const MarginEvaluator evaluator = Evaluator();
  const SuperposedWalk walk = Walk();
  const auto lines =
      MissedDemandsText(evaluator, FindMissedDemands(evaluator, walk, WitnessOf(evaluator, walk)));
  EXPECT_THAT(lines.front(),
              AllOf(HasSubstr("_LINK2"), HasSubstr("tau = "), HasSubstr("; missed at ")));
  EXPECT_THAT(lines,
              Contains(AllOf(HasSubstr("what may help with self_clearance: "),
                             HasSubstr("excluded_self_pairs"), Not(HasSubstr("less demanded")))));
  EXPECT_THAT(lines, Contains(AllOf(HasSubstr("what may help with zmp: "),
                                    HasSubstr("half_step.duration_s"),
                                    HasSubstr("less demanded (`smoothing.margins.zmp_m` below"))));
}

TEST_F(MissedDemandsTest, ALegThatDoesNotReachIsSaidOnceAndByHowMuch) {
  experiment_.robot.waist_height += 0.05;
  const MarginEvaluator evaluator = Evaluator();
  const SuperposedWalk walk = Walk();
  const MissedDemands missed = FindMissedDemands(evaluator, walk, WitnessOf(evaluator, walk));
  ASSERT_FALSE(missed.demands.empty());
  int reach = 0;
  for (const MissedDemand& demand : missed.demands) {
    reach += demand.worst.family == MarginFamily::kReach;
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
