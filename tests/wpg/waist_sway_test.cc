#include "wpg/motion/waist_sway.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "tests/wpg/hrp2.h"
#include "tests/wpg/sequence_draw.h"
#include "tests/wpg/symmetric_masses.h"
#include "wpg/motion/compensation.h"
#include "wpg/motion/posture.h"
#include "wpg/motion/robot_dynamics.h"

namespace halfstep {
namespace {

using Eigen::Vector2d;

WaistSway RandomSway(SequenceDraw* draw) {
  WaistSway sway;
  for (int k = 0; k < WaistSway::kControls; ++k) {
    sway.controls.emplace_back(draw->Uniform(-0.03, 0.03), draw->Uniform(-0.03, 0.03));
  }
  return sway;
}

// One of value, first, … third, along both axes.
Vector2d Both(const std::array<ProfileJet, 2>& jet, double ProfileJet::*what) {
  return {jet[0].*what, jet[1].*what};
}

TEST(WaistSway, IsAtRestAtBothEndsAndSmoothBetweenItsPieces) {
  SequenceDraw draw(1);
  const WaistSway sway = RandomSway(&draw);
  constexpr double kT = 1.7, kAside = 1e-9;
  for (int knot = 0; knot <= WaistSway::kPieces; ++knot) {
    const double tau = kT * knot / WaistSway::kPieces;
    const auto before = sway.At(tau - kAside, kT), after = sway.At(tau + kAside, kT);
    for (const auto what : {&ProfileJet::value, &ProfileJet::first, &ProfileJet::second}) {
      EXPECT_LT((Both(after, what) - Both(before, what)).norm(), 1e-6) << knot;
    }
  }
  for (const double tau : {-1.0, 0.0, kT, kT + 1.0}) {
    for (const ProfileJet& d : sway.At(tau, kT)) {
      EXPECT_EQ(d.value, 0.0);
      EXPECT_EQ(d.second, 0.0);
      EXPECT_EQ(d.third, 0.0);
    }
  }
}

TEST(WaistSway, IsTheSumOfItsSplinesAndAgreesWithDifferences) {
  SequenceDraw draw(2);
  int wrong_caught = 0;
  for (int i = 0; i < 300; ++i) {
    const WaistSway sway = RandomSway(&draw);
    const double T = draw.Uniform(0.5, 3.0), h = 1e-5;
    const int piece = static_cast<int>(draw.Uniform(0, WaistSway::kPieces));
    const double tau = T * (piece + draw.Uniform(0.01, 0.99)) / WaistSway::kPieces;
    const auto jet = sway.At(tau, T), more = sway.At(tau + h, T), less = sway.At(tau - h, T);
    Vector2d value(0, 0), first(0, 0), second(0, 0);
    const double rate = WaistSway::kPieces / T;
    for (int k = 0; k < WaistSway::kControls; ++k) {
      const Eigen::Vector3d B = CubicBSpline(rate * tau - k);
      value += B[0] * sway.controls[static_cast<size_t>(k)];
      first += rate * B[1] * sway.controls[static_cast<size_t>(k)];
      second += rate * rate * B[2] * sway.controls[static_cast<size_t>(k)];
    }
    EXPECT_LT((value - Both(jet, &ProfileJet::value)).norm(), 1e-15);
    EXPECT_LT((first - Both(jet, &ProfileJet::first)).norm(), 1e-13);
    EXPECT_LT((second - Both(jet, &ProfileJet::second)).norm(), 1e-12);
    const auto slope = [&](double ProfileJet::*of) {
      return Vector2d((Both(more, of) - Both(less, of)) / (2 * h));
    };
    EXPECT_LT((slope(&ProfileJet::value) - Both(jet, &ProfileJet::first)).norm(), 1e-7);
    EXPECT_LT((slope(&ProfileJet::first) - Both(jet, &ProfileJet::second)).norm(), 1e-6);
    EXPECT_LT((slope(&ProfileJet::second) - Both(jet, &ProfileJet::third)).norm(), 1e-5);
    // At fixed τ, with respect to T.
    const auto longer = sway.At(tau, T + h), shorter = sway.At(tau, T - h);
    const auto slope_T = [&](double ProfileJet::*of) {
      return Vector2d((Both(longer, of) - Both(shorter, of)) / (2 * h));
    };
    EXPECT_LT((slope_T(&ProfileJet::value) - Both(jet, &ProfileJet::value_T)).norm(), 1e-7);
    EXPECT_LT((slope_T(&ProfileJet::first) - Both(jet, &ProfileJet::first_T)).norm(), 1e-6);
    EXPECT_LT((slope_T(&ProfileJet::second) - Both(jet, &ProfileJet::second_T)).norm(), 1e-5);
    // A derivative that takes the form for one of fixed seconds.
    wrong_caught += slope_T(&ProfileJet::first).norm() > 1e-6;
  }
  EXPECT_GT(wrong_caught, 290);
}

TEST(WaistSway, BoundsHoldAndAreExact) {
  SequenceDraw draw(3);
  for (int i = 0; i < 500; ++i) {
    const WaistSway sway = RandomSway(&draw);
    const double T = draw.Uniform(0.5, 3.0);
    const double from = T * draw.Uniform(-0.2, 1.1),
                 to = from + T * std::pow(10, draw.Uniform(-3, 0));
    const Vector2d bound = sway.SecondBound(from, to, T);
    const auto thirds = sway.ThirdRange(from, to, T);
    Vector2d most(0, 0);
    constexpr int kInstants = 400;
    for (int k = 0; k <= kInstants; ++k) {
      const auto jet = sway.At(from + (to - from) * k / kInstants, T);
      most = most.cwiseMax(Both(jet, &ProfileJet::second).cwiseAbs());
      for (size_t axis : {0, 1}) {
        EXPECT_LE(std::abs(jet[axis].third - thirds[axis].center),
                  thirds[axis].radius * (1 + 1e-12) + 1e-9);
      }
    }
    EXPECT_TRUE((most.array() <= bound.array() + 1e-12).all());
    // What 400 instants miss of a function that is affine between knots.
    const double missed = (to - from) / kInstants * (thirds[0].most() + thirds[1].most());
    EXPECT_TRUE((bound.array() <= most.array() + missed + 1e-12).all());
  }
  EXPECT_TRUE(WaistSway{}.SecondBound(0, 1, 1).isZero());
}

// What no sway can change of the ZMP: e^{±ωτ} is in the kernel of Z, and both ends are at rest.
TEST(WaistSway, ItsZmpHasNoMomentWithTheModesOfTheLipm) {
  SequenceDraw draw(5);
  const Lipm lipm;
  for (int i = 0; i < 20; ++i) {
    const WaistSway sway = RandomSway(&draw);
    const double T = draw.Uniform(0.6, 3.0);
    for (const double rate : {lipm.omega(), -lipm.omega()}) {
      double moment = 0, size = 0;
      constexpr int kInstants = 12000;  // a thousand a piece, by the midpoint rule
      for (int k = 0; k < kInstants; ++k) {
        const double tau = T * (k + 0.5) / kInstants;
        const ProfileJet x = sway.At(tau, T)[0];
        const double zmp = lipm.Zmp(x.value, x.second) * std::exp(rate * tau);
        moment += zmp;
        size += std::abs(zmp);
      }
      EXPECT_LT(std::abs(moment), 1e-5 * size);
    }
  }
}

TEST(WaistSway, MirrorsAndTurnsAsItsHalfStepDoes) {
  SequenceDraw draw(4);
  const Lipm lipm;
  HalfStep half_step;
  half_step.X_SF = Foothold::Level({0.1, -0.2, 0.1});
  half_step.sway = RandomSway(&draw);
  const HalfStepProfiles profiles(half_step.kind, half_step.shape, half_step.duration, lipm);
  HalfStep still = half_step;
  still.sway = {};
  for (double tau = 0.05; tau < half_step.duration; tau += 0.1) {
    const WalkJet x = Evaluate(half_step, profiles, tau), plain = Evaluate(still, profiles, tau);
    const WalkJet mirrored = Evaluate(half_step.Mirrored(), profiles, tau);
    EXPECT_LT((mirrored.value - Mirrored(x.value)).norm(), 1e-15);
    EXPECT_LT((mirrored.second - Mirrored(x.second)).norm(), 1e-12);
    const Vector2d d = x.value.segment<2>(kComX) - plain.value.segment<2>(kComX);
    EXPECT_LT((d - Both(half_step.sway.At(tau, half_step.duration), &ProfileJet::value)).norm(),
              1e-15);
    EXPECT_EQ(x.value.tail<kNumQuantities - 2>(), plain.value.tail<kNumQuantities - 2>());
  }
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(0.7).toRotationMatrix();
  const auto turned = half_step.sway.Turned(R).At(0.8, 2.0), jet = half_step.sway.At(0.8, 2.0);
  EXPECT_LT((Both(turned, &ProfileJet::first) - R * Both(jet, &ProfileJet::first)).norm(), 1e-15);
}

// The ZMP of the robot less the planned one, root of the mean square over the half-step [m].
double ZmpError(const RobotModel& robot, const HalfStep& half_step, const Lipm& lipm) {
  const HalfStepProfiles profiles(half_step.kind, half_step.shape, half_step.duration, lipm);
  double sum = 0;
  constexpr int kInstants = 200;
  for (int i = 0; i < kInstants; ++i) {
    const WalkJet jet = Evaluate(half_step, profiles, half_step.duration * (i + 0.5) / kInstants);
    Posture posture = SolvePosture(robot, jet.value);
    if (!posture.reachable || !SolveJointSpeeds(robot, jet, &posture)) return INFINITY;
    const auto zmp = RobotDynamics(robot, jet, posture, lipm.gravity).Zmp();
    sum += (*zmp - jet.value.segment<2>(kZmpX)).squaredNorm();
  }
  return std::sqrt(sum / kInstants);
}

TEST(Compensation, BringsTheZmpOfIsolatedHalfStepsNearer) {
  const RobotModel robot = Hrp2();
  const Lipm lipm{.com_height = robot.com_height};
  for (const HalfStepKind kind : {HalfStepKind::kUp, HalfStepKind::kDown}) {
    const double ahead = kind == HalfStepKind::kUp ? -0.2 : 0.2;
    HalfStep half_step{
        .kind = kind, .X_SF = Foothold::Level({ahead, -0.21, 0.1}), .duration = 2.0, .shape = {}};
    const WaistSway one = Compensation(robot, half_step, lipm, 1),
                    two = Compensation(robot, half_step, lipm, 2);
    ASSERT_FALSE(one.none());
    // Of what the first iteration moves, the second moves little more.
    double first = 0, second = 0;
    for (size_t k = 0; k < one.controls.size(); ++k) {
      first = std::max(first, one.controls[k].norm());
      second = std::max(second, (two.controls[k] - one.controls[k]).norm());
    }
    EXPECT_LT(second, 0.25 * first);
    EXPECT_LT(first, 0.05);
    for (const double duration : {1.0, 2.0}) {
      half_step.duration = duration;
      half_step.sway = {};
      const double without = ZmpError(robot, half_step, lipm);
      half_step.sway = two;
      EXPECT_LT(ZmpError(robot, half_step, lipm), 0.95 * without) << duration;
      half_step.sway = two.Scaled(-1);  // the wrong way
      EXPECT_GT(ZmpError(robot, half_step, lipm), 1.05 * without) << duration;
    }
  }
}

TEST(Compensation, OfAMirroredHalfStepIsMirrored) {
  const RobotModel robot = WithSymmetricMasses(Hrp2());
  const Lipm lipm{.com_height = robot.com_height};
  const HalfStep half_step{.X_SF = Foothold::Level({-0.1, -0.2, -0.1}), .shape = {}};
  const WaistSway sway = Compensation(robot, half_step, lipm, 2).Mirrored(),
                  mirrored = Compensation(robot, half_step.Mirrored(), lipm, 2);
  for (size_t k = 0; k < sway.controls.size(); ++k) {
    EXPECT_LT((sway.controls[k] - mirrored.controls[k]).norm(), 1e-9);
  }
}

TEST(Compensation, LeavesALegHalfOfWhatItHasLeft) {
  const RobotModel robot = Hrp2();
  const Lipm lipm{.com_height = robot.com_height};
  // The swing foot is so far behind that its leg is nearly stretched.
  HalfStep half_step{.X_SF = Foothold::Level({-0.274, -0.17, 0}), .duration = 2.0, .shape = {}};
  const auto least_reach = [&] {
    const HalfStepProfiles profiles(half_step.kind, half_step.shape, half_step.duration, lipm);
    double least = 1;
    for (double tau = 0; tau <= half_step.duration; tau += 1e-3) {
      const Posture posture = SolvePosture(robot, Evaluate(half_step, profiles, tau).value);
      for (const LegIkSolution& leg : posture.ik) least = std::min(least, leg.reach_margin);
    }
    return least;
  };
  const double before = least_reach();
  ASSERT_GT(before, 0);
  half_step.sway = Compensation(robot, half_step, lipm, 2);
  EXPECT_GE(least_reach(), 0.49 * before);
}

TEST(Compensation, NeedsMassesAndIsNothingWithoutIterations) {
  RobotModel robot = Hrp2();
  const Lipm lipm{.com_height = robot.com_height};
  EXPECT_TRUE(
      Compensation(robot, {.X_SF = Foothold::Level({0, -0.2, 0}), .shape = {}}, lipm, 0).none());
  EXPECT_THROW((void)Compensation(robot, {}, lipm, -1), std::logic_error);
  robot.masses.fault = "no masses";
  EXPECT_THROW((void)Compensation(robot, {}, lipm, 1), std::logic_error);
}

}  // namespace
}  // namespace halfstep
