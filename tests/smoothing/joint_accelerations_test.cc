// Joint accelerations and their limits: values and slopes against differences, bounds over
// intervals against dense samples, and what is said where nothing is limited.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "opt/problem/derivative_check.h"
#include "smoothing/margins/slack_evaluator.h"
#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/proof/interval_statements.h"
#include "smoothing/walk/posture_tangent.h"
#include "tests/smoothing/drawn_motion.h"
#include "tests/wpg/joint_limits.h"
#include "wpg/motion/dynamics_slope.h"

namespace halfstep {
namespace {

constexpr double kG = 9.81;
constexpr MarginFamily kFamily = MarginFamily::kJointAcceleration;

std::vector<RobotModel> AllLegs() {
  std::vector<RobotModel> robots = RobotsOfAllKinds();
  for (RobotModel& robot : RobotsWithOffsets()) robots.push_back(std::move(robot));
  return robots;
}

Eigen::VectorXd Accelerations(const RobotModel& robot, const WalkJet& jet, const Posture& posture) {
  const RobotDynamics motion(robot, jet, posture, kG);
  Eigen::VectorXd all(12);
  all << motion.accelerations(Side::kLeft), motion.accelerations(Side::kRight);
  return all;
}

TEST(JointAccelerations, AreTheRatesOfJointSpeeds) {
  constexpr double kStep = 1e-3;
  unsigned seed = 900;
  for (const RobotModel& robot : AllLegs()) {
    WalkDraw draw(seed++);
    int compared = 0;
    double worst = 0, largest = 0;
    for (int i = 0; i < Draws(60); ++i) {
      const SuperposedWalk walk = DrawnWalkOf(robot, &draw);
      const double t = draw.Uniform(0.05, walk.duration() - 0.05);
      if (NearKnot(walk, t, 4 * kStep)) continue;
      const auto speeds = [&](double s) -> std::optional<Eigen::VectorXd> {
        const auto posture = MovingPosture(robot, walk.At(t + s));
        if (!posture) return std::nullopt;
        Eigen::VectorXd both(12);
        both << posture->speeds[0], posture->speeds[1];
        return both;
      };
      // Central differences of sixth order.
      Eigen::VectorXd rate = Eigen::VectorXd::Zero(12);
      bool solved = true;
      for (const auto& [steps, weight] : {std::pair{1, 45.0}, {2, -9.0}, {3, 1.0}}) {
        const auto later = speeds(steps * kStep), earlier = speeds(-steps * kStep);
        solved = solved && later && earlier;
        if (solved) rate += weight * (*later - *earlier);
      }
      if (!solved) continue;
      rate /= 60 * kStep;
      ++compared;
      const WalkJet jet = walk.At(t);
      const Eigen::VectorXd there = Accelerations(robot, jet, *MovingPosture(robot, jet));
      worst = std::max(worst, ((there - rate).array() / (1 + rate.array().abs())).abs().maxCoeff());
      largest = std::max(largest, rate.cwiseAbs().maxCoeff());
    }
    EXPECT_GT(compared, Draws(60) / 4) << robot.name;
    EXPECT_LT(worst, 1e-6) << robot.name;
    EXPECT_GT(largest, 5.0) << robot.name;
  }
}

TEST(JointAccelerations, HaveTheSlopesOfDifferences) {
  unsigned seed = 910;
  for (const RobotModel& robot : AllLegs()) {
    WalkDraw draw(seed++);
    int compared = 0;
    for (int i = 0; i < Draws(60); ++i) {
      const SuperposedWalk walk = DrawnWalkOf(robot, &draw);
      const WalkJet jet = walk.At(draw.Uniform(0, walk.duration()));
      const auto posture = MovingPosture(robot, jet);
      if (!posture) continue;
      const WalkJet along = DrawnRates(&draw);
      const RobotDynamics motion(robot, jet, *posture, kG);
      const PostureTangent tangent = Differentiate(robot, jet, *posture, along);
      const DynamicsSlope slope(robot, jet, *posture, motion, {along, tangent.q, tangent.speeds});
      Eigen::MatrixXd slopes(12, 1);
      slopes << slope.accelerations(Side::kLeft), slope.accelerations(Side::kRight);
      slopes *= 0.01;  // in units of 100 rad/s²
      const auto function = [&](const Eigen::VectorXd& h) -> Eigen::VectorXd {
        const WalkJet moved = Along(jet, h[0], along);
        const auto there = MovingPosture(robot, moved);
        if (!there) return Eigen::VectorXd::Constant(12, std::nan(""));
        return 0.01 * Accelerations(robot, moved, *there);
      };
      constexpr double kStep = 1e-5;
      const Eigen::VectorXd here = Eigen::VectorXd::Zero(1);
      const DerivativeReport report = CheckJacobian(function, here, slopes, kStep);
      if (!report.finite) continue;
      ++compared;
      EXPECT_TRUE(report.Passed(1e-6)) << robot.name << ": " << report.Describe();
      for (const Eigen::Index broken : {0, 3, 11}) {
        Eigen::MatrixXd wrong = slopes;
        wrong(broken, 0) += 1e-3 + 0.01 * std::abs(wrong(broken, 0));
        EXPECT_FALSE(CheckJacobian(function, here, wrong, kStep).Passed(1e-6)) << broken;
      }
    }
    EXPECT_GT(compared, Draws(60) / 4) << robot.name;
  }
}

// The rows of the overlap program, along every parameter of a walk.
TEST(JointAccelerationMargin, RowsHaveTheSlopesOfDifferences) {
  const RobotModel robot = WithAccelerationLimits(Hrp2(), 20.0);
  const MarginEvaluator evaluator(robot, {}, {});
  SlackEvaluator slacks(evaluator, 100.0);
  WalkDraw draw(920);
  int compared = 0, kinks = 0, caught = 0;
  for (int i = 0; i < Draws(25); ++i) {
    const HalfStepSequence sequence = DrawSequence(robot, 2, {.stride = 0.7}, &draw);
    const HomotopyParameters parameters = draw.Parameters(sequence, 0.05, 0.8);
    const SuperposedWalk walk(sequence, parameters);
    const double t = draw.Uniform(0, walk.duration());
    if (NearKnot(walk, t, 2e-3)) continue;
    const LocalTime at = walk.Locate(t);
    const auto rows_of = [&](const HomotopyParameters& p, bool gradient, InstantSlacks* all) {
      slacks.At(SuperposedWalk(sequence, p), at, {}, gradient, all);
      std::vector<size_t> rows;
      for (size_t r = 0; r < all->rows.size(); ++r) {
        if (all->rows[r].family == kFamily) rows.push_back(r);
      }
      return rows;
    };
    InstantSlacks here;
    const std::vector<size_t> rows = rows_of(parameters, true, &here);
    if (rows.empty()) continue;  // a leg does not reach
    ASSERT_EQ(rows.size(), 12u);
    for (size_t p = 0; p < here.parameters.size(); ++p) {
      const auto slopes = [&](double h) -> std::optional<Eigen::VectorXd> {
        HomotopyParameters more = parameters, less = parameters;
        here.parameters[p].in(more) += h;
        here.parameters[p].in(less) -= h;
        InstantSlacks a, b;
        const std::vector<size_t> of_a = rows_of(less, false, &a), of_b = rows_of(more, false, &b);
        if (of_a.size() != 12 || of_b.size() != 12) return std::nullopt;
        Eigen::VectorXd slope(12);
        for (size_t k = 0; k < 12; ++k) {
          slope[static_cast<Eigen::Index>(k)] =
              (b.rows[of_b[k]].slack - a.rows[of_a[k]].slack) / (2 * h);
        }
        return slope;
      };
      const auto coarse = slopes(1e-5), fine = slopes(2e-6);
      if (!coarse || !fine) continue;
      for (Eigen::Index k = 0; k < 12; ++k) {
        const double size = 1 + std::abs((*fine)[k]);
        if (std::abs((*coarse)[k] - (*fine)[k]) > 1e-4 * size) {
          ++kinks;  // |q̈| has none but at zero
          continue;
        }
        const double analytic = here.gradient(
            static_cast<Eigen::Index>(rows[static_cast<size_t>(k)]), static_cast<Eigen::Index>(p));
        EXPECT_NEAR(analytic, (*fine)[k], 1e-3 * size) << k << " along parameter " << p;
        ++compared;
        caught += std::abs(-analytic - (*fine)[k]) > 1e-3 * size;  // the control: a wrong sign
      }
    }
  }
  EXPECT_GT(compared, Draws(25) * 50);
  EXPECT_LT(kinks, compared / 20);
  EXPECT_GT(caught, compared / 4);
}

// Each joint by itself: the others have no limits, so that the row is of it.
TEST(JointAccelerationMargin, IsNeverBelowWhatIsProvedOnRandomIntervals) {
  MarginLimits undemanding;
  undemanding.demanded.fill(-1e4);
  unsigned seed = 930;
  for (const RobotModel& plain : AllLegs()) {
    WalkDraw draw(seed++);
    const MotionBounds bounds(plain);
    int intervals = 0;
    double excess = -1, nearest = 0;
    std::vector<MarginEvaluator> of_joint;
    for (size_t j = 0; j < 12; ++j) {
      RobotModel robot = plain;
      robot.legs[j / 6].joints[j % 6].max_acceleration = 10.0;
      of_joint.emplace_back(robot, Scene{}, undemanding);
    }
    for (int i = 0; i < Draws(60); ++i) {
      const HalfStepSequence sequence = DrawSequence(plain, 2, {}, &draw);
      const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
      for (int k = 0; k < 12; ++k) {
        const double length = 1e-4 * std::pow(700.0, draw.Uniform(0, 1));
        const double begin = draw.Uniform(0.0, walk.duration() - length);
        if (!KnotsInside(walk, {begin, begin + length}).empty()) continue;
        const MarginEvaluator& evaluator = of_joint[static_cast<size_t>(k)];
        MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
        OpenGroups open = {{kFamily, 0}};
        Certificate rows;
        IntervalStatements(evaluator).Prove(walk, begin, begin + length, &open, &scratch, &rows);
        if (rows.size() != 1) continue;  // not bounded
        ++intervals;
        ASSERT_EQ(rows[0].margin.subject, k);
        ASSERT_EQ(rows[0].count, 12);
        for (const double part : {0.0, draw.Uniform(0, 1), draw.Uniform(0, 1), 1.0}) {
          const LocalTime at = walk.Locate(begin + part * length);
          const double truth = Of(evaluator.At(walk, at, &scratch), kFamily).value;
          const double fall = rows[0].margin.value - truth;
          excess = std::max(excess, fall - rows[0].bound);
          if (fall > 1e-3) nearest = std::max(nearest, fall / rows[0].bound);
        }
      }
    }
    EXPECT_GT(intervals, Draws(60)) << plain.name;
    EXPECT_LT(excess, 0.0) << plain.name;
    RecordProperty(plain.name + "_nearest_percent", static_cast<int>(100 * nearest));
    // By norms: half of a bound, or a term forgotten, shows.
    EXPECT_GT(nearest, kFewDraws ? 0.2 : 0.5) << plain.name;
  }
}

TEST(JointAccelerationMargin, IsThereOnlyWhereTheRobotFileStatesALimit) {
  RobotModel robot = Hrp2();
  const HalfStepSequence sequence = WalkDraw(940).Sequence(1);
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  MarginLimits limits;
  limits.demanded_of(kFamily) = 3.0;
  const MarginEvaluator none(robot, {}, limits);
  EXPECT_THAT(none.families(), testing::Not(testing::Contains(kFamily)));
  EXPECT_EQ(none.limits().demanded_of(kFamily), kNotDemanded);
  MarginEvaluator::Scratch scratch = none.MakeScratch();
  EXPECT_EQ(Of(none.At(walk, {0, 1.0}, &scratch), kFamily).value, kUnlimited);
  const CertifiedFeasibility of_none(none, {});
  EXPECT_EQ(of_none.CountOf(kFamily), 0);
  for (const OpenGroup& group : IntervalStatements(none).All()) EXPECT_NE(group.family, kFamily);
  SlackEvaluator slacks(none, 1e9);
  InstantSlacks instant;
  slacks.At(walk, {0, 1.0}, {}, true, &instant);
  for (const SlackRow& row : instant.rows) EXPECT_NE(row.family, kFamily);
  // One joint's limit is stated.
  robot.legs[1].joints[3].max_acceleration = 1e-3;
  const MarginEvaluator one(robot, {}, limits);
  EXPECT_THAT(one.families(), testing::Contains(kFamily));
  EXPECT_EQ(CertifiedFeasibility(one, {}).CountOf(kFamily), 12);
  const Margin margin = Of(one.At(walk, {0, 1.0}, &scratch), kFamily);
  EXPECT_EQ(one.Subject(margin), "RLEG_JOINT3");
  EXPECT_LT(margin.value, 0.0);
  const auto violated = one.FirstViolation(walk, {0, 1.0}, &scratch);
  ASSERT_TRUE(violated);
  EXPECT_EQ(violated->family, kFamily);
  // And nothing is demanded of it.
  limits.demanded_of(kFamily) = kNotDemanded;
  EXPECT_FALSE(one.WithLimits(limits).FirstViolation(walk, {0, 1.0}, &scratch));
}

// Nothing of it depends on masses.
TEST(JointAccelerationMargin, IsTheSameOfOtherMasses) {
  RobotModel robot = WithAccelerationLimits(Hrp2(), 300.0);
  const HalfStepSequence sequence = WalkDraw(941).Sequence(1);
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  MarginLimits limits;
  limits.demanded.fill(-1e4);
  limits.demanded_of(kFamily) = 0.0;
  const auto certified = [&] {
    const MarginEvaluator evaluator(robot, {}, limits);
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    Certificate certificate;
    const CertifiedFeasibility test(evaluator, {});
    EXPECT_EQ(test.Certify(walk, &scratch, &certificate).verdict, Verdict::kFeasible);
    std::erase_if(certificate, [](const CertificateRow& row) { return row.family != kFamily; });
    return certificate;
  };
  const Certificate as_is = certified();
  ASSERT_GT(as_is.size(), 10u);
  const auto compare = [&](double bounds_differ) {
    const Certificate others = certified();
    for (const CertificateRow& row : as_is) {
      const auto same = std::ranges::find_if(others, [&](const CertificateRow& other) {
        return other.begin == row.begin && other.end == row.end;
      });
      ASSERT_NE(same, others.end());
      EXPECT_EQ(same->margin.value, row.margin.value);
      EXPECT_NEAR(same->bound, row.bound, bounds_differ);
    }
  };
  // The waist's, and all of a robot's where their centres stay: nothing changes.
  BodyMass& waist = robot.masses.waist;
  waist.com += Eigen::Vector3d(0.1, 0.05, 0.4);
  compare(0.0);
  waist.mass *= 3.0;
  for (auto& leg : robot.masses.links) {
    for (BodyMass& link : leg) {
      link.mass *= 2.0;
      link.inertia *= 2.0;
    }
  }
  compare(0.0);
  // A link's CoM is one of its points, each of which is placed with rounding, so that bounds differ
  // by a few units in the last place.
  robot.masses = RobotMasses{};
  compare(1e-14);
}

}  // namespace
}  // namespace halfstep
