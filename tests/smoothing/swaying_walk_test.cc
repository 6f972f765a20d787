// Walks whose half-steps sway: what is superposed, derivatives, bounds, and proofs.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "opt/problem/derivative_check.h"
#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/program/walk_effort.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/smoothing/motion_truth.h"
#include "tests/smoothing/test_walks.h"
#include "wpg/motion/robot_drift.h"
#include "wpg/motion/robot_dynamics.h"
#include "wpg/motion/zmp_drift.h"

namespace halfstep {
namespace {

constexpr double kSwayGravity = 9.81;

// Every half-step sways by up to `most` [m] along each axis.
HalfStepSequence Swaying(HalfStepSequence sequence, double most, SequenceDraw* draw) {
  for (auto& [half_step, X_WS] : sequence.half_steps) {
    for (int k = 0; k < WaistSway::kControls; ++k) {
      half_step.sway.controls.emplace_back(draw->Uniform(-most, most), draw->Uniform(-most, most));
    }
  }
  return sequence;
}

bool NearSwayKnot(const SuperposedWalk& walk, double t, double distance) {
  for (int i = 0; i < walk.num_half_steps(); ++i) {
    const double piece = walk.profiles(i).duration() / WaistSway::kPieces;
    const double x = std::remainder(t - walk.start_of(i), piece);
    if (std::abs(x) < distance) return true;
  }
  return false;
}

TEST(SwayingWalk, AddsTheSwaysOfTheHalfStepsUnderWayToTheComAlone) {
  WalkDraw draw(61);
  for (int i = 0; i < Draws(30); ++i) {
    const HalfStepSequence sequence = Swaying(draw.Sequence(3), 0.02, &draw);
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence)),
        plain = walk.WithoutSway();
    for (int k = 0; k < 40; ++k) {
      const double t = draw.Uniform(0, walk.duration());
      const WalkJet x = walk.At(t), y = plain.At(t);
      Eigen::Vector2d value(0, 0), second(0, 0);
      for (int m = 0; m < walk.num_half_steps(); ++m) {
        const auto sway =
            walk.half_step(m).sway.At(t - walk.start_of(m), walk.profiles(m).duration());
        const Eigen::Matrix2d R = walk.X_WS(m).Planar().rotation();
        value += R * Eigen::Vector2d(sway[0].value, sway[1].value);
        second += R * Eigen::Vector2d(sway[0].second, sway[1].second);
      }
      EXPECT_LT(((x.value - y.value).segment<2>(kComX) - value).norm(), 1e-13);
      EXPECT_LT(((x.second - y.second).segment<2>(kComX) - second).norm(),
                1e-9 * (1 + second.norm()));
      EXPECT_EQ(x.value.tail<kNumQuantities - 2>(), y.value.tail<kNumQuantities - 2>());
    }
    for (const double end : {0.0, walk.duration()}) {
      EXPECT_LT((walk.At(end).value - plain.At(end).value).norm(), 1e-13);
      EXPECT_LT((walk.At(end).second - plain.At(end).second).norm(), 1e-11);
    }
    EXPECT_EQ(EffortOf(walk).com_jerk, EffortOf(plain).com_jerk);
  }
}

TEST(SwayingWalk, SensitivitiesAgreeWithDifferencesAndWithoutTheSwayDoNot) {
  WalkDraw draw(62);
  int caught = 0, tried = 0;
  for (int i = 0; i < Draws(200); ++i) {
    const HalfStepSequence sequence = Swaying(draw.Sequence(3), 0.02, &draw);
    const HomotopyParameters parameters = draw.Parameters(sequence, 0.02, 0.98);
    const std::vector<HomotopyParameter> all = AllParameters(sequence);
    const SuperposedWalk walk(sequence, parameters);
    double t = draw.Uniform(0, walk.duration());
    while (NearKnot(walk, t, 1e-3) || NearSwayKnot(walk, t, 1e-3)) {
      t = draw.Uniform(0, walk.duration());
    }
    const LocalTime at = walk.Locate(t);
    const auto function = [&](const Eigen::VectorXd& d) {
      HomotopyParameters moved = parameters;
      for (size_t p = 0; p < all.size(); ++p) all[p].in(moved) += d[static_cast<Eigen::Index>(p)];
      return Stacked(SuperposedWalk(sequence, moved).At(at));
    };
    const auto jacobian = [&](const SuperposedWalk& of) {
      Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3 * kNumQuantities, std::ssize(all));
      std::vector<WalkSensitivity> sensitivities;
      of.Sensitivities(at, &sensitivities);
      for (const WalkSensitivity& s : sensitivities) {
        J.col(std::find(all.begin(), all.end(), s.parameter) - all.begin()) = Stacked(s.jet);
      }
      return J;
    };
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(std::ssize(all));
    const DerivativeReport report = CheckJacobian(function, zero, jacobian(walk));
    EXPECT_TRUE(report.Passed(1e-6)) << report.Describe();
    ++tried;
    caught += !CheckJacobian(function, zero, jacobian(walk.WithoutSway())).Passed(1e-6);
  }
  EXPECT_GT(caught, 9 * tried / 10);
}

TEST(SwayingWalk, SecondAndThirdBoundsHoldAndWithoutTheSwayDoNot) {
  WalkDraw draw(63);
  int exceeded = 0, intervals = 0;
  for (int i = 0; i < Draws(100); ++i) {
    const HalfStepSequence sequence = Swaying(draw.Sequence(3), 0.02, &draw);
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence)),
        plain = walk.WithoutSway();
    for (int k = 0; k < 10; ++k, ++intervals) {
      const double length = 1e-3 * std::pow(100, draw.Uniform(0, 1));
      const double begin = draw.Uniform(0, walk.duration() - length);
      const WalkState second = walk.SecondBounds(begin, begin + length),
                      forgotten = plain.SecondBounds(begin, begin + length);
      const WalkThirds thirds = walk.ThirdRanges(begin, begin + length);
      bool beyond = false;
      WalkState last = walk.At(begin).second;
      for (int m = 1; m <= 20; ++m) {
        const WalkState now = walk.At(begin + length * m / 20).second;
        for (const int q : {kComX, kComY}) {
          EXPECT_LE(std::abs(now[q]), second[q] * (1 + 1e-12) + 1e-12);
          // A difference of second derivatives is a mean of third ones.
          const double rate = (now[q] - last[q]) / (length / 20);
          EXPECT_LE(std::abs(rate - thirds.center[q]), thirds.radius[q] * (1 + 1e-9) + 1e-8);
          beyond |= std::abs(now[q]) > forgotten[q];
        }
        last = now;
      }
      exceeded += beyond;
    }
  }
  EXPECT_GT(exceeded, intervals / 100);
}

// What the ZMP of the robot may go within random intervals, by bounds of the walk with its sways
// and by those that forget them.
TEST(SwayingWalk, TheRobotsZmpStaysWithinItsBoundAndBeyondOneThatForgetsTheSway) {
  const RobotModel robot = Hrp2();
  const MotionBounds bounds(robot);
  WalkDraw draw(64);
  int bounded = 0, beyond = 0;
  for (int i = 0; i < Draws(60); ++i) {
    const HalfStepSequence sequence = Swaying(draw.Sequence(2), 0.012, &draw);
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence)),
        plain = walk.WithoutSway();
    for (int k = 0; k < 10; ++k) {
      const double length = 1e-3 * std::pow(30.0, draw.Uniform(0, 1));
      const double begin = draw.Uniform(0.0, walk.duration() - length), end = begin + length;
      const WalkJet middle = walk.At(begin + 0.5 * length);
      IntervalMotion motion, forgetful;
      bounds.Bound(middle, walk.SecondBounds(begin, end), 0.5 * length, &motion);
      bounds.Bound(middle, plain.SecondBounds(begin, end), 0.5 * length, &forgetful);
      if (!motion.bounded || !forgetful.bounded) continue;
      const RobotDynamics dynamics(robot, middle, motion.posture, kSwayGravity);
      const auto zmp = dynamics.Zmp();
      if (!zmp) continue;
      const auto drift_of = [&](const IntervalMotion& of, const WalkThirds& thirds) {
        return ZmpDrift::Over(robot, of, thirds,
                              RobotDrift(robot, of, thirds, dynamics, kSwayGravity), dynamics,
                              kSwayGravity);
      };
      const ZmpDrift drift = drift_of(motion, walk.ThirdRanges(begin, end)),
                     wrong = drift_of(forgetful, plain.ThirdRanges(begin, end));
      if (!(drift.least_push > 0)) continue;
      ++bounded;
      bool exceeded = false;
      for (const double part : {0.0, draw.Uniform(0, 1), 1.0}) {
        const WalkJet jet = walk.At(begin + part * length);
        Posture posture = SolvePosture(robot, jet.value);
        ASSERT_TRUE(posture.reachable && SolveJointSpeeds(robot, jet, &posture));
        const auto there = RobotDynamics(robot, jet, posture, kSwayGravity).Zmp();
        ASSERT_TRUE(there);
        for (const Eigen::Vector2d& along : {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)}) {
          const double moved = std::abs(along.dot(*there - *zmp));
          EXPECT_LE(moved, drift.Along(along) + 1e-9);
          exceeded |= moved > wrong.Along(along) + 1e-9;
        }
      }
      beyond += exceeded;
    }
  }
  EXPECT_GT(bounded, Draws(60) * 2);
  EXPECT_GT(beyond, bounded / 20);
}

}  // namespace
}  // namespace halfstep
