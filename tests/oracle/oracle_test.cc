// The oracle against the readmes' own conditions, against the project, and a small fixed slice of
// its study.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "smoothing/walk/superposed_walk.h"
#include "tests/oracle/judge.h"
#include "tests/oracle/project_side.h"
#include "tests/temporary_folder.h"
#include "tests/wpg/shipped_robots.h"

namespace halfstep::oracle {
namespace {

constexpr char kRobot[] = HALFSTEP_SOURCE_DIR "/wpg/robots/hrp2.yaml";

TEST(RestToRestClosedFormTest, KeepsTheLipmAndItsEnds) {
  for (const double theta : {0.6, 3.0, 6.94, 20.0}) {
    for (const double shift : {0.01, 0.05, 0.5}) {
      for (const double ramp : {1.0, 0.24, 0.7}) {
        const RestToRestClosedForm pair(theta, shift, ramp);
        const auto c = [&](double sigma) { return pair.At(static_cast<Real>(sigma)); };
        // c″ = θ²(c − p) by differences of the slope, away from the knots.
        for (const double sigma : {0.11, 0.2, 0.31, 0.5 - 0.2 * shift, 0.5 + 0.3 * shift, 0.83}) {
          const Real h = 1e-7;
          const Real s = sigma;
          const double second =
              static_cast<double>((pair.At(s + h).c_rate - pair.At(s - h).c_rate) / (2 * h));
          const double expected = theta * theta * static_cast<double>(c(sigma).c - c(sigma).p);
          EXPECT_NEAR(second, expected, 1e-6 * (1 + theta * theta)) << theta << " " << shift;
        }
        EXPECT_NEAR(static_cast<double>(c(1e-12).c_rate), 0, 1e-9);
        EXPECT_NEAR(static_cast<double>(c(0.5).c), 0.5, 1e-15);
        const double knot = 0.5 - 0.5 * shift;
        EXPECT_NEAR(static_cast<double>(c(knot - 1e-9).c - c(knot + 1e-9).c), 0, 1e-7);
      }
    }
  }
}

TEST(ClosedFormWalkTest, AgreesWithTheProject) {
  const PlainRobot robot(kRobot);
  for (unsigned seed = 0; seed < 20; ++seed) {
    Draw draw(seed);
    const WalkPlan plan = DrawPlan(robot, &draw);
    const ClosedFormWalk oracle(plan);
    const SuperposedWalk walk(ToSequence(plan), ToParameters(plan));
    ASSERT_NEAR(oracle.duration(), walk.duration(), 1e-12);
    for (int k = 0; k <= 50; ++k) {
      const double t = walk.duration() * k / 50;
      const WalkState state = oracle.At(static_cast<Real>(t));
      const WalkJet jet = walk.At(t);
      const double far = 1e-12 + 1e-15 * jet.value.cwiseAbs().maxCoeff();
      EXPECT_LT((state.value.com - jet.value.segment<2>(kComX)).norm(), far) << seed << " " << t;
      EXPECT_LT((state.value.zmp - jet.value.segment<2>(kZmpX)).norm(), far);
      EXPECT_NEAR(state.value.waist_yaw, jet.value[kWaistYaw], far);
      EXPECT_LT((state.rate.com - jet.first.segment<2>(kComX)).norm(), 1e-10);
      for (int foot = 0; foot < 2; ++foot) {
        const int q = foot == 0 ? kLeftX : kRightX;
        const auto& feet = state.value.feet[static_cast<size_t>(foot)];
        EXPECT_LT((feet - jet.value.segment<4>(q)).norm(), far);
        const auto& rates = state.rate.feet[static_cast<size_t>(foot)];
        EXPECT_LT((rates - jet.first.segment<4>(q)).norm(), 1e-10);
      }
    }
  }
}

class PlainRobotTest : public testing::TestWithParam<std::string> {
 protected:
  const std::string path_ = HALFSTEP_SOURCE_DIR "/wpg/robots/" + GetParam() + ".yaml";
};
INSTANTIATE_TEST_SUITE_P(Robots, PlainRobotTest, testing::ValuesIn(kShippedRobots),
                         [](const auto& info) { return info.param; });

TEST_P(PlainRobotTest, ReadsWhatTheProjectReads) {
  const PlainRobot plain(path_);
  const RobotModel robot = LoadRobot(path_);
  EXPECT_NEAR(plain.waist_height, robot.waist_height, 1e-12);
  EXPECT_NEAR(plain.com_x, robot.com_x_B, 1e-12);
  EXPECT_NEAR(plain.com_height, robot.com_height, 1e-12);
  EXPECT_NEAR(plain.standing_width, robot.standing_width, 1e-12);
  ASSERT_EQ(plain.bodies.size(), robot.bodies.size());
  for (int leg = 0; leg < 2; ++leg) {
    for (int j = 0; j < 6; ++j) {
      const auto& a = plain.joints[static_cast<size_t>(
          plain.legs[static_cast<size_t>(leg)].joints[static_cast<size_t>(j)])];
      const LegJoint& b = robot.legs[static_cast<size_t>(leg)].joints[static_cast<size_t>(j)];
      EXPECT_EQ(a.name, b.name);
      EXPECT_NEAR(a.lower, b.lower, 1e-15);
      EXPECT_NEAR(a.upper, b.upper, 1e-15);
      EXPECT_EQ(a.speed, b.max_speed);
    }
  }
}

TEST_P(PlainRobotTest, WatchesTheSamePairs) {
  const PlainRobot plain(path_);
  const RobotModel robot = LoadRobot(path_);
  std::set<std::set<std::string>> ours, theirs;
  for (const auto& [a, b] : plain.watched) {
    ours.insert(
        {plain.bodies[static_cast<size_t>(a)].name, plain.bodies[static_cast<size_t>(b)].name});
  }
  for (const auto& [a, b] : robot.self_pairs) {
    theirs.insert(
        {robot.bodies[static_cast<size_t>(a)].name, robot.bodies[static_cast<size_t>(b)].name});
  }
  EXPECT_EQ(ours, theirs);
}

TEST_P(PlainRobotTest, InverseKinematicsReachesTheSole) {
  const PlainRobot robot(path_);
  Draw draw(3);
  for (int k = 0; k < 200; ++k) {
    const int leg = draw.Below(2);
    Vector6 q = robot.Standing(leg);
    for (int j = 0; j < 6; ++j) q[j] += draw.Uniform(-0.2, 0.2);
    Vector6 found = robot.Standing(leg);
    ASSERT_TRUE(robot.SolveLeg(leg, robot.PlaceLeg(leg, q)[6], &found)) << k;
    EXPECT_LT((found - q).norm(), 1e-11) << k;
  }
}

TEST(MinNormPointTest, BracketsTheDistanceOfBoxesAndNeedles) {
  Draw draw(5);
  for (int k = 0; k < 3000; ++k) {
    ConvexSet a, b;
    const double scale = draw.Logarithmic(1e-4, 1e2);
    for (int n = 1 + draw.Below(12); n > 0; --n) a.points.push_back(draw.Vector(-0.2, 0.2));
    for (int n = 1 + draw.Below(4); n > 0; --n) {
      b.points.push_back(Eigen::Vector3d(draw.Uniform(-0.1, 0.6), 0, 0) +
                         scale * draw.Vector(-1, 1));
    }
    if (draw.Chance(0.3)) b.disc = draw.Logarithmic(1e-4, 0.1);
    const Bracket found = DistanceOf(a, b);
    EXPECT_LE(found.lower, found.upper + 1e-14);
    EXPECT_LT(found.upper - found.lower, b.disc > 0 ? 1e-7 : 1e-11) << k << " " << found.upper;
  }
}

TEST(PlainSceneTest, KnowsInsideFromOutside) {
  Draw draw(7);
  PlainScene scene;
  for (const SceneKind kind : {SceneKind::kClosedMeshes, SceneKind::kNested}) {
    const PlainRobot robot(kRobot);
    const WalkPlan plan = DrawPlan(robot, &draw);
    for (const PlainObstacle& o : DrawNastyScene(kind, plan, robot.size(), &draw).obstacles) {
      scene.obstacles.push_back(o);
    }
  }
  const PlacedScene placed(scene, {0, 0, 0});
  for (size_t o = 0; o < placed.size(); ++o) {
    const auto far = placed.Around(o, {50, 60, 70});
    EXPECT_NEAR(far.component, 0, 1e-12);
    EXPECT_FALSE(far.maybe());
  }
}

// Falsehoods of a few walks of each kind: none. The whole study: tests/oracle/README.md.
TEST(OracleTest, NoAnswerIsFalse) {
  const TemporaryFolder folder;
  const Judge judge(kRobot);
  std::vector<std::string> falsehoods;
  Tally all;
  for (unsigned w = 0; w < kNumSceneKinds; ++w) {
    all.Add(judge.JudgeOne(static_cast<SceneKind>(w % kNumSceneKinds), 77000000u + w,
                           folder.path().string(), &falsehoods));
  }
  EXPECT_THAT(falsehoods, testing::IsEmpty());
  EXPECT_GT(all.judged, kNumSceneKinds / 2);
  EXPECT_GT(all.violated, kNumSceneKinds);
}

}  // namespace
}  // namespace halfstep::oracle
