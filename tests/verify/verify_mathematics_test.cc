// verify's own closed forms against the program's, which share no line with them.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "experiments/verify/robot_numbers.h"
#include "experiments/verify/robot_posture.h"
#include "experiments/verify/sole_polygon.h"
#include "tests/places.h"
#include "tests/verify/plan_of.h"
#include "wpg/geometry/support_polygon.h"
#include "wpg/motion/half_step_tracks.h"
#include "wpg/motion/lipm.h"
#include "wpg/motion/moved_footsteps.h"
#include "wpg/motion/posture.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep::verify {
namespace {

double Draw(double from, double to, std::mt19937* random) {
  return std::uniform_real_distribution<double>(from, to)(*random);
}

Pose2 DrawPlace(double size, std::mt19937* random) {
  return {Draw(-size, size, random), Draw(-size, size, random), Draw(-size, size, random)};
}

// Two steps over levels with forms of their own, the second on a moved footstep.
HalfStepSequence DrawSequence(std::mt19937* random) {
  const auto level = [random](const Pose2& X_WF) { return Foothold(X_WF, Draw(0, 0.08, random)); };
  const Pose2 left{0.1, 0.1, 0.2}, right{0, -0.1, -0.1};
  HalfStepSequence sequence =
      MakeSequence({level(left), level(right)},
                   {{Side::kRight, level(right * DrawPlace(0.3, random)), 0.1, 1.2},
                    {Side::kLeft, level(left * DrawPlace(0.3, random)), 0.2, 1.5}},
                   0.2, {}, std::make_shared<Lipm>(0.8));
  for (auto& [half_step, X_WS, rest] : sequence.half_steps) {
    half_step.duration = Draw(0.3, 3, random);
    half_step.via_along = Draw(-0.1, 0.1, random);
    half_step.shape.shift = Draw(0.01, 0.5, random);
    half_step.shape.bump_ramp = Draw(0, 1, random) < 0.3 ? 0.5 : Draw(0.1, 1, random);
    half_step.shape.foot_delay = Draw(0, 0.2, random);
    half_step.shape.foot_ramp = Draw(0, 1, random) < 0.3 ? 0.5 : Draw(0.1, 0.5, random);
    half_step.shape.lift_share = Draw(0.2, 1, random);
    half_step.shape.support_point = Draw(-0.03, 0.03, random);
    half_step.shape.rise_begin = Draw(0, 0.75, random);
    half_step.shape.rise_end = Draw(0.85, 1, random);
    half_step.shape.crouch = 0.03;
  }
  return sequence;
}

TEST(HalfStepMotion, IsTheProgramsHalfStep) {
  std::mt19937 random(1);
  for (int k = 0; k < 60; ++k) {
    const HalfStepSequence sequence = DrawSequence(&random);
    const WalkPlan plan = PlanOf(sequence);
    for (size_t i = 0; i < plan.half_steps.size(); ++i) {
      const auto& [half_step, X_WS, rest] = sequence.half_steps[i];
      const HalfStepTracks tracks(half_step, *sequence.model, X_WS);
      const HalfStepMotion motion(plan.half_steps[i],
                                  dynamic_cast<const Lipm&>(*sequence.model).omega());
      EXPECT_NEAR(motion.foot_begin(), tracks.horizontal_begin(), 1e-15);
      EXPECT_NEAR(motion.foot_end(), tracks.horizontal_end(), 1e-15);
      EXPECT_NEAR(motion.t1(), tracks.t1(), 1e-15);
      EXPECT_NEAR(motion.t2(), tracks.t2(), 1e-15);
      for (int n = 0; n < 40; ++n) {
        const double tau = Draw(-0.1, 1.1, &random) * half_step.duration;
        const double to = tau + Draw(0, 0.2, &random);
        const WalkJet jet = tracks.At(tau);
        WalkState bounds = WalkState::Zero();
        tracks.AddSecondBounds(tau, to, &bounds);
        WalkInstant at{.value = motion.start()};
        motion.AddAt(tau, &at);
        for (int q = 0; q < kNumQuantities; ++q) {
          EXPECT_NEAR(at.value[q], jet.value[q], 1e-12) << q;
          EXPECT_NEAR(at.first[q], jet.first[q], 1e-11) << q;
          EXPECT_NEAR(at.second[q], jet.second[q], 1e-9) << q;
        }
        const Eigen::Vector2d sums = bounds.segment<2>(kComX) + bounds.segment<2>(kZmpX);
        const Eigen::Vector2d own = motion.SecondBounds(tau, to);
        EXPECT_NEAR((own - sums).norm(), 0, 1e-9 * (1 + sums.norm()));
      }
    }
  }
}

// The pendulum's equation and both ends at rest, whoever solved it.
TEST(ZmpShift, MovesAPendulumFromRestToRest) {
  for (const double theta : {0.5, 3.0, 6.94, 20.0, 60.0}) {
    for (const double width : {0.01, 0.05, 0.5}) {
      for (const double ramp : {0.1, 0.3, 0.5, 0.7, 1.0}) {
        const ZmpShift shift(theta, width, ramp);
        for (double sigma = 1e-9; sigma < 1; sigma += 0.0037) {
          const Jet com = shift.Com(sigma);
          const double residual = com.second / (theta * theta) - com.value + shift.Zmp(sigma).value;
          EXPECT_NEAR(residual, 0, 1e-11 * (1 + shift.ComSecondBound())) << theta << " " << sigma;
          EXPECT_LE(std::abs(com.second), shift.ComSecondBound() + 1e-9);
        }
        EXPECT_NEAR(shift.Com(0.5).value, 0.5, 1e-12);
        EXPECT_NEAR(shift.Com(1e-9).first, 0, 1e-6);
      }
    }
  }
  EXPECT_THROW(ZmpShift(0.4, 0.05, 1), std::logic_error);
  EXPECT_THROW(ZmpShift(5, 0.6, 1), std::logic_error);
  EXPECT_THROW(ZmpShift(5, 0.05, 0), std::logic_error);
}

TEST(WalkPlan, MovesFootstepsAsTheProgramDoes) {
  std::mt19937 random(2);
  for (int k = 0; k < 50; ++k) {
    const HalfStepSequence sequence = DrawSequence(&random);
    const std::vector<Pose2> moves = {DrawPlace(0.1, &random), DrawPlace(0.1, &random)};
    const HalfStepSequence theirs = WithFootstepsMoved(sequence, moves);
    const WalkPlan own = Moved(PlanOf(sequence), moves);
    for (size_t i = 0; i < own.half_steps.size(); ++i) {
      for (const Foothold& between :
           {theirs.half_steps[i].X_WS.Inverse() * own.half_steps[i].X_WS,
            theirs.half_steps[i].half_step.X_SF.Inverse() * own.half_steps[i].half_step.X_SF}) {
        EXPECT_NEAR(between.Planar().position().norm() + std::abs(between.yaw), 0, 1e-14);
        EXPECT_NEAR(between.height, 0, 1e-15);
      }
    }
  }
}

// HRP-2 with hip and ankle axes that miss each other.
RobotModel WithOffsets(RobotModel robot) {
  for (Leg& leg : robot.legs) {
    leg.met = {leg};
    leg.joints[0].point_B.x() += 0.02;
    leg.joints[5].point_B.z() -= 0.01;
  }
  return robot;
}

// Poses within reach and beyond it. Of legs without closed form, the program may prove fewer.
TEST(RobotPosture, AnglesAreThoseOfTheProgram) {
  std::mt19937 random(3);
  const auto load = [](const char* name) {
    return LoadRobot(InSources("wpg/robots/") + std::string(name) + ".yaml");
  };
  const RobotModel hrp2 = load("hrp2");
  for (const RobotModel& robot : {hrp2, load("wren"), load("bison"), WithOffsets(hrp2)}) {
    const double size = LegLength(robot);
    EXPECT_NEAR(size, LegLengthOf(robot), 1e-12);
    int compared = 0;
    for (int k = 0; k < 400; ++k) {
      WalkNumbers x;
      for (double& value : x) value = Draw(-0.3, 0.3, &random) * size;
      x[kLeftX + 1] += robot.standing_width / 2;
      x[kRightX + 1] -= robot.standing_width / 2;
      const Posture theirs = SolvePosture(robot, x);
      const RobotPosture own = PostureOf(robot, x);
      EXPECT_GE(own.reached, theirs.reachable) << robot.name;
      for (size_t s = 0; s < 2; ++s) {
        if (theirs.ik[s].status != LegIkStatus::kSolved) {
          EXPECT_TRUE(!robot.legs[s].closed_form() || own.q[s].array().isNaN().all());
          continue;
        }
        ++compared;
        EXPECT_NEAR((own.q[s] - theirs.ik[s].q).norm(), 0, 1e-9) << robot.name;
        for (size_t j = 0; j < 7; ++j) {
          EXPECT_TRUE(own.OfLink(s, j).isApprox(theirs.X_WLink[s][j], 1e-10)) << robot.name;
        }
      }
    }
    EXPECT_GT(compared, 100) << robot.name;
    EXPECT_LT(compared, 800) << robot.name;
  }
}

TEST(SolePolygon, MarginIsTheProgramsForOneAndTwoSoles) {
  std::mt19937 random(4);
  const Eigen::Vector2d size{0.22, 0.14};
  for (int k = 0; k < 300; ++k) {
    const Pose2 left = DrawPlace(0.4, &random);
    // Now and then side by side, where corners lie on one line.
    const Pose2 right = k % 3 == 0 ? left * Pose2{0, -0.2, 0} : DrawPlace(0.4, &random);
    const SolePolygon one({left}, size), two({left, right}, size);
    for (int n = 0; n < 20; ++n) {
      const Eigen::Vector2d p{Draw(-0.5, 0.5, &random), Draw(-0.5, 0.5, &random)};
      EXPECT_NEAR(one.Margin(p), SupportPolygon(left, size).Margin(p), 1e-12);
      EXPECT_NEAR(two.Margin(p), SupportPolygon(left, right, size).Margin(p), 1e-9);
    }
  }
  // From the centre of a sole along its length.
  EXPECT_NEAR(SolePolygon({{}}, size).LongestWay({0, 0}), 0.11, 1e-15);
}

}  // namespace
}  // namespace halfstep::verify
