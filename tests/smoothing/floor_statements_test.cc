#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "smoothing/margins/body_heights.h"
#include "smoothing/margins/slack_evaluator.h"
#include "smoothing/methods/walk_problem.h"
#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/proof/sampled_feasibility.h"
#include "tests/smoothing/row_differences.h"
#include "tests/smoothing/short_walks.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

int BodyNamed(const RobotModel& robot, const std::string& name) {
  const auto found = std::find_if(robot.bodies.begin(), robot.bodies.end(),
                                  [&](const RobotBody& b) { return b.name == name; });
  return static_cast<int>(found - robot.bodies.begin());
}

// A ball of `radius` [m] on a body's link, where it is `below` [m] under the body's lowest point
// when the robot stands: such as a tool in a hand, or a guard before a shin.
RobotModel WithBall(const std::string& body, double radius, double height) {
  RobotModel robot = Hrp2();
  const int of = BodyNamed(robot, body);
  const HalfStepSequence sequence = MakeSequence(
      StandingFeet(robot),
      {{.side = Side::kRight, .X_WF = Foothold::Level({0, -0.5 * robot.standing_width, 0})}}, 0.24,
      {}, std::make_shared<Lipm>(robot.com_height));
  const SuperposedWalk standing(sequence, PlannedMotion(sequence));
  const Posture posture = SolvePosture(robot, standing.At(0.0).value);
  RobotBody ball = robot.bodies[static_cast<size_t>(of)];
  ball.name = "BALL";
  const Eigen::Isometry3d X = posture.OfBody(ball);
  Eigen::Vector3d p_W = X * ball.shape.center;
  p_W.z() = height + radius;
  ball.shape = MakeSphere(radius);
  ball.shape.vertices.col(0) = X.inverse() * p_W;
  BoundBySphere(&ball.shape);
  robot.bodies.push_back(ball);
  return robot;
}

// The lemma of smoothing/README.md, "The foot never goes below the floor", interval by interval.
class LeastHeight : public testing::TestWithParam<double> {};

TEST_P(LeastHeight, IsNeverAboveTheSoleAndNeverBelowTheLowerFootstep) {
  WalkDraw draw(601, GetParam());
  int intervals = 0, tight = 0;
  for (int i = 0; i < Draws(60); ++i) {
    const HalfStepSequence sequence = draw.Sequence(3);
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
    std::vector<double> knots = KnotsInside(walk, {0.0, walk.duration()});
    knots.push_back(walk.duration());
    double begin = 0.0;
    for (double end : knots) {
      const int step = walk.StepInAir(walk.Locate(0.5 * (begin + end)));
      for (int part = 0; part < 3 && step >= 0; ++part) {
        double a = begin, b = end;
        if (part > 0) a = draw.Uniform(begin, end), b = draw.Uniform(a, end);
        const double least = walk.LeastHeight(step, a, b);
        const int z = FootIndex(walk.half_step(2 * step).swing()) + 2;
        double truth = kUnlimited;
        for (int k = 0; k <= 60; ++k) {
          truth = std::min(truth, walk.At(a + (b - a) * k / 60.0).value[z]);
        }
        EXPECT_LE(least, truth + 1e-13) << "[" << a << ", " << b << "]";
        const double support = walk.X_WS(2 * step).height;
        const double lower = support + std::min(walk.half_step(2 * step).X_SF.height,
                                                walk.half_step(2 * step + 1).X_SF.height);
        EXPECT_GE(least, lower - 1e-12);
        EXPECT_LE(least, kSoleRounding + truth);
        ++intervals;
        tight += least > lower && truth - least < 0.1 * (truth - lower);
      }
      begin = end;
    }
  }
  EXPECT_GT(intervals, Draws(60) * 20);
  EXPECT_GT(tight, intervals / 20);
}

INSTANTIATE_TEST_SUITE_P(Rises, LeastHeight, testing::Values(0.0, 0.15));

// Nothing hides an overlap that is too long: the sole goes below the floor, and the bound with it.
TEST(LeastHeightOfAStep, OfAnOverlapBeyondItsBoundIsBelowTheFloor) {
  const HalfStepSequence sequence = TwoSteps(Hrp2());
  SuperposedWalk walk(sequence, Overlapped(sequence, 1.0));
  walk.SetOverlap(0, walk.parameters().overlaps[0] + 0.9 * kOverlapTolerance);
  double lowest = kUnlimited;
  for (int k = 0; k <= 4000; ++k) {
    lowest = std::min(lowest, walk.At(walk.duration() * k / 4000.0).value[kRightZ]);
  }
  EXPECT_LT(lowest, -1e-14);
  EXPECT_GT(lowest, -kSoleRounding);
  const std::vector<double> knots = KnotsInside(walk, {0.0, walk.duration()});
  double least = kUnlimited;
  for (size_t k = 0; k + 1 < knots.size(); ++k) {
    if (walk.StepInAir(walk.Locate(0.5 * (knots[k] + knots[k + 1]))) != 0) continue;
    least = std::min(least, walk.LeastHeight(0, knots[k], knots[k + 1]));
  }
  EXPECT_LE(least, lowest + 1e-15);  // rounding of the height itself
  EXPECT_GT(least, -kSoleRounding);
}

// The foot begins its horizontal motion, or ends it, a fifth of a millisecond of rise too low, and
// is high enough everywhere else: no interval may hide that behind a midpoint at which the height
// does not count.
TEST(Floor, IsNotCertifiedWhereTheFootIsTooLowForAMoment) {
  const RobotModel robot = Hrp2();
  WalkDraw draw(607);
  int certified = 0;
  for (int i = 0; i < Draws(40); ++i) {
    const HalfStepSequence sequence = TwoSteps(robot);
    HomotopyParameters parameters = PlannedMotion(sequence);
    for (double& T : parameters.durations) T *= draw.Uniform(0.9, 1.3);
    // Of one half-step the delay is short, so that its height counts where it is least.
    const size_t low = static_cast<size_t>(i % 4);
    for (size_t k = 0; k < 4; ++k)
      parameters.of(ParameterFamily::kFootDelay)[k] = k == low ? 0.08 : 0.15;
    const SuperposedWalk walk(sequence, parameters);
    const HalfStepTracks& p = walk.tracks(static_cast<int>(low));
    const bool up = low % 2 == 0;
    const double at =
        walk.start_of(static_cast<int>(low)) + (up ? p.horizontal_begin() : p.horizontal_end());
    const int z = FootIndex(walk.half_step(static_cast<int>(low)).swing()) + 2;
    const double height = walk.At(at).value[z];
    const double later = walk.At(at + (up ? 2e-4 : -2e-4)).value[z];
    ASSERT_GT(later, height + 1e-7);
    Certificate certificate;
    EXPECT_NE(Certify(robot, {}, Only(MarginFamily::kFloor, later), walk, &certificate).verdict,
              Verdict::kFeasible)
        << "at " << at << " s";
    certified +=
        Certify(robot, {}, Only(MarginFamily::kFloor, 0.99 * height), walk, &certificate).verdict ==
        Verdict::kFeasible;
  }
  EXPECT_EQ(certified, Draws(40));
}

TEST(Ground, IsTheHeightOfTheLowestPointOfBodiesThatAreOnNoFoot) {
  const RobotModel robot = WithBall("LLEG_LINK3", 0.03, 0.02);
  const MarginEvaluator evaluator(robot, {}, {});
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  WalkDraw draw(602);
  const SuperposedWalk walk(TwoSteps(robot), Overlapped(TwoSteps(robot), 0.7));
  for (int i = 0; i < Draws(100); ++i) {
    const LocalTime at = walk.Locate(draw.Uniform(0, walk.duration()));
    const Posture posture = SolvePosture(robot, walk.At(at).value);
    ASSERT_TRUE(posture.reachable);
    double lowest = kUnlimited;
    int which = -1;
    for (size_t b = 0; b < robot.bodies.size(); ++b) {
      const RobotBody& body = robot.bodies[b];
      if (IsOnFoot(body)) continue;
      ASSERT_EQ(body.shape.disc_radius, 0.0);
      const Eigen::Matrix3Xd points_W =
          posture.OfBody(body) * Eigen::Matrix3Xd(body.shape.vertices);
      const double height = points_W.row(2).minCoeff() - body.shape.ball_radius;
      if (height < lowest) which = static_cast<int>(b);
      lowest = std::min(lowest, height);
    }
    const Margin ground = Of(evaluator.At(walk, at, &scratch), MarginFamily::kGround);
    EXPECT_NEAR(ground.value, lowest, 1e-12);
    EXPECT_EQ(ground.subject, which);
  }
}

// A foot stands on the floor all the time, and is no worst margin for it.
TEST(Ground, AFootThatTouchesTheFloorHasNoLimit) {
  RobotModel robot = Hrp2();
  std::erase_if(robot.bodies, [](const RobotBody& body) { return !IsOnFoot(body); });
  robot.self_pairs.clear();
  const SuperposedWalk walk(TwoSteps(robot), Overlapped(TwoSteps(robot), 0.9));
  const MarginEvaluator evaluator(robot, {}, Only(MarginFamily::kGround, 0.0));
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  EXPECT_EQ(Of(SampleMargins(evaluator, walk, 0.01, &scratch), MarginFamily::kGround).value,
            kUnlimited);
  Certificate certificate;
  EXPECT_EQ(CertifiedFeasibility(evaluator, {}).Certify(walk, &scratch, &certificate).verdict,
            Verdict::kFeasible);
  // But not below it.
  WalkState x = walk.At(0.0).value;
  x[kRightZ] = -1e-6;
  const Margin below = evaluator.heights().Least(SolvePosture(robot, x), x);
  EXPECT_EQ(below.value, -1e-6);
  EXPECT_EQ(evaluator.Subject(below), "RLEG_LINK5");
}

// Where the ground is lower than the soles, or higher, all heights above it are.
TEST(Ground, HeightsCountFromItsFloor) {
  const RobotModel robot = Hrp2();
  const HalfStepSequence sequence = TwoSteps(robot);
  const SuperposedWalk walk(sequence, Overlapped(sequence, 0.5));
  const auto at_height = [](double height) {
    Scene scene;
    scene.ground = std::make_shared<const FlatGround>(height);
    return scene;
  };
  const MarginLimits limits = Only(MarginFamily::kGround, 0.0);
  const MarginEvaluator flat(robot, {}, limits), lower(robot, at_height(-0.02), limits);
  MarginEvaluator::Scratch a = flat.MakeScratch(), b = lower.MakeScratch();
  int moving = 0;
  for (int n = 0; n <= 100; ++n) {
    const LocalTime at = walk.Locate(walk.duration() * n / 100);
    for (const MarginFamily family : {MarginFamily::kFloor, MarginFamily::kGround}) {
      const Margin here = Of(flat.At(walk, at, &a), family),
                   there = Of(lower.At(walk, at, &b), family);
      EXPECT_EQ(here.subject, there.subject);
      if (std::isinf(here.value)) continue;
      EXPECT_NEAR(there.value, here.value + 0.02, 1e-15);
      moving += family == MarginFamily::kFloor;
    }
  }
  EXPECT_GT(moving, 20);
  Certificate certificate;
  const Feasibility sunk = Certify(robot, at_height(1e-3), limits, walk, &certificate);
  EXPECT_EQ(sunk.verdict, Verdict::kViolated);
  EXPECT_EQ(sunk.witness.family, MarginFamily::kGround);
  for (const double height : {-1e-3, 1e-3}) {
    EXPECT_THROW(WalkProblem(robot, at_height(height), sequence, limits), std::logic_error);
  }
}

TEST(Ground, ABodyThatReachesBelowTheFloorIsAViolation) {
  // A tool that a hand holds, 1 mm into the floor all the time; 1 mm above it.
  for (double height : {-0.001, 0.001}) {
    const RobotModel robot = WithBall("WAIST", 0.02, height);
    const SuperposedWalk walk(TwoSteps(robot), Overlapped(TwoSteps(robot), 0.5));
    Certificate certificate;
    const Feasibility answer =
        Certify(robot, {}, Only(MarginFamily::kGround, 0.0), walk, &certificate);
    EXPECT_EQ(answer.verdict, height < 0 ? Verdict::kViolated : Verdict::kFeasible);
    if (height < 0) {
      EXPECT_EQ(answer.witness.family, MarginFamily::kGround);
      EXPECT_NEAR(answer.witness.value, height, 1e-12);
    }
    EXPECT_NE(Certify(robot, {}, Only(MarginFamily::kGround, 0.0011), walk, &certificate).verdict,
              Verdict::kFeasible);
  }
}

// A guard on a shin dips below the floor for a moment in which the shin leans, and nowhere else.
TEST(Ground, AShinThatDipsBelowTheFloorIsSeenAndOneThatDoesNotIsCertified) {
  WalkDraw draw(603);
  int violated = 0, certified = 0, undecided = 0;
  for (int i = 0; i < Draws(40); ++i) {
    const RobotModel robot =
        WithBall(i % 2 == 0 ? "LLEG_LINK3" : "RLEG_LINK4", 0.01, draw.Uniform(-0.005, 0.03));
    const SuperposedWalk walk(TwoSteps(robot), Overlapped(TwoSteps(robot), draw.Uniform(0, 0.9)));
    const MarginEvaluator evaluator(robot, {}, Only(MarginFamily::kGround, 0.0));
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    const double truth =
        Of(SampleMargins(evaluator, walk, 5e-4, &scratch), MarginFamily::kGround).value;
    Certificate certificate;
    const Feasibility answer =
        CertifiedFeasibility(evaluator, {}).Certify(walk, &scratch, &certificate);
    if (truth < -1e-5) {
      EXPECT_EQ(answer.verdict, Verdict::kViolated) << truth;
    } else if (truth < 0.0) {
      EXPECT_NE(answer.verdict, Verdict::kFeasible) << truth;
    } else if (truth > 1e-4) {
      EXPECT_EQ(answer.verdict, Verdict::kFeasible) << truth;
    }
    violated += answer.verdict == Verdict::kViolated;
    certified += answer.verdict == Verdict::kFeasible;
    undecided += answer.verdict == Verdict::kUndecided;
  }
  EXPECT_GT(violated, Draws(40) / 8);
  EXPECT_GT(certified, Draws(40) / 4);
  EXPECT_LE(undecided, Draws(40) / 8);
}

// Balls under legs and under the waist, two at a time: the lowest is never below margin − bound.
TEST(Ground, RowsOfACertificateHoldThroughoutTheirIntervals) {
  WalkDraw draw(606);
  for (const auto& [one, other] : std::vector<std::pair<std::string, std::string>>{
           {"LLEG_LINK3", "RLEG_LINK4"}, {"LLEG_LINK4", "LLEG_LINK3"}, {"LLEG_LINK3", "WAIST"}}) {
    RobotModel robot = WithBall(one, 0.01, 0.05);
    if (BodyNamed(robot, other) < static_cast<int>(robot.bodies.size())) {
      robot.bodies.push_back(WithBall(other, 0.01, 0.03).bodies.back());
    } else {  // rigid with the waist
      RobotBody ball = robot.bodies.front();
      ball.leg = ball.link = -1;
      ball.shape = MakeSphere(0.01);
      ball.shape.vertices.col(0).z() -= robot.waist_height - 0.03;
      BoundBySphere(&ball.shape);
      robot.bodies.push_back(ball);
    }
    const SuperposedWalk walk(TwoSteps(robot), Overlapped(TwoSteps(robot), 0.6));
    const MarginEvaluator evaluator(robot, {}, Only(MarginFamily::kGround, -0.1));
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    Certificate certificate;
    ASSERT_EQ(CertifiedFeasibility(evaluator, {}).Certify(walk, &scratch, &certificate).verdict,
              Verdict::kFeasible);
    int rows = 0;
    for (const CertificateRow& row : certificate) {
      if (row.family != MarginFamily::kGround) continue;
      ++rows;
      for (const double at : {1e-9, draw.Uniform(0, 1), 1 - 1e-9}) {
        const LocalTime t = walk.Locate(row.begin + at * (row.end - row.begin));
        EXPECT_GE(Of(evaluator.At(walk, t, &scratch), MarginFamily::kGround).value,
                  row.margin.value - row.bound)
            << row.begin << " … " << row.end;
      }
    }
    EXPECT_GT(rows, 5);
  }
}

TEST(Ground, RowsHaveDerivatives) {
  const RobotModel robot = WithBall("LLEG_LINK3", 0.01, 0.01);
  const MarginEvaluator evaluator(robot, {}, Only(MarginFamily::kGround, 0.0));
  const RowDifferences found =
      CompareLeastRow(evaluator, TwoSteps(robot), MarginFamily::kGround, 6.0, 604);
  EXPECT_EQ(found.without_row, 0);
  EXPECT_GE(found.compared, Draws(60));
}

}  // namespace
}  // namespace halfstep
