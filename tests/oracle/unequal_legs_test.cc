// The oracle on robots whose left and right legs differ.

#include "tests/oracle/unequal_legs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <tuple>

#include "tests/oracle/judge.h"
#include "tests/temporary_folder.h"
#include "tests/wpg/shipped_robots.h"

namespace halfstep::oracle {
namespace {

constexpr unsigned kSeed = 77000100u;

class UnequalLegsTest : public testing::TestWithParam<std::string> {
 protected:
  std::string Write(const UnequalLegs& drawn, const TemporaryFolder& folder) const {
    return WriteUnequalRobot(GetParam(), drawn, folder.path().string());
  }
};
INSTANTIATE_TEST_SUITE_P(Robots, UnequalLegsTest, testing::ValuesIn(kShippedRobots),
                         [](const auto& info) { return info.param; });

TEST_P(UnequalLegsTest, BothSidesReadThem) {
  for (const bool offset : {false, true}) {
    const TemporaryFolder folder;
    const std::string path = Write({.seed = kSeed, .offset = offset}, folder);
    const PlainRobot plain(path);
    const RobotModel robot = LoadRobot(path);
    EXPECT_FALSE(robot.legs_are_mirrored);
    EXPECT_NEAR(plain.waist_height, robot.waist_height, 1e-12);
    EXPECT_NEAR(plain.com_x, robot.com_x_B, 1e-12);
    EXPECT_NEAR(plain.standing_width, robot.standing_width, 1e-12);
    EXPECT_EQ(plain.watched.size(), robot.self_pairs.size());
    for (size_t leg = 0; leg < 2; ++leg) {
      const Leg& theirs = robot.legs[leg];
      EXPECT_EQ(theirs.closed_form(), !offset);
      EXPECT_EQ(plain.legs[leg].axes_meet, !offset);
      const int of = static_cast<int>(leg);
      EXPECT_NEAR((plain.HipInWaist(of) - theirs.hip_B).norm(), 0, 1e-12);
      EXPECT_NEAR((plain.Standing(of) - theirs.standing_q).norm(), 0, 1e-14);
      for (size_t j = 0; j < 6; ++j) {
        const auto& a = plain.joints[static_cast<size_t>(plain.legs[leg].joints[j])];
        const LegJoint& b = theirs.joints[j];
        EXPECT_NEAR(a.lower, b.lower, 1e-15);
        EXPECT_NEAR(a.upper, b.upper, 1e-15);
        EXPECT_EQ(a.speed, b.max_speed);
        EXPECT_EQ(a.effort, b.max_torque);
        EXPECT_EQ(a.acceleration, b.max_acceleration);
      }
    }
    const auto& of_left = robot.legs[0].joints[3];
    const auto& of_right = robot.legs[1].joints[3];
    EXPECT_NE(of_left.max_speed, of_right.max_speed);
    EXPECT_NE(of_left.max_torque, of_right.max_torque);
    EXPECT_GT(std::abs(plain.LongestReach(0) - plain.LongestReach(1)), 1e-4);
  }
}

TEST_P(UnequalLegsTest, NoAnswerIsFalse) {
  Tally all;
  std::vector<std::string> falsehoods;
  for (const bool offset : {false, true}) {
    const TemporaryFolder folder;
    const Judge judge(Write({.seed = kSeed, .offset = offset}, folder));
    const auto families = offset ? std::array{MarginFamily::kReach, MarginFamily::kTorque}
                                 : std::array{MarginFamily::kJoint, MarginFamily::kZmpRobot};
    for (const MarginFamily family : families) {
      all.Add(judge.JudgeFamily(family, SceneKind::kMoving, kSeed, folder.path().string(),
                                &falsehoods));
    }
  }
  EXPECT_THAT(falsehoods, testing::IsEmpty());
  EXPECT_GE(all.judged, 4);
  for (const auto& [name, family] : all.families) {
    EXPECT_EQ(family.found, family.falsified) << name;
    EXPECT_LT(family.disagreement, 1e-8) << name;
  }
}

// An oracle that does not know how the right leg differs calls answers false.
TEST_P(UnequalLegsTest, AnOracleThatTakesTheRightLegForAnotherFindsFalsehoods) {
  const std::vector<std::tuple<Unknown, MarginFamily>> mistakes = {
      {Unknown::kLengths, MarginFamily::kReach},
      {Unknown::kAxes, MarginFamily::kJoint},
      {Unknown::kAngleLimits, MarginFamily::kJoint},
      {Unknown::kSpeedLimits, MarginFamily::kJointSpeed},
      {Unknown::kTorques, MarginFamily::kTorque},
      {Unknown::kAccelerations, MarginFamily::kJointAcceleration},
      {Unknown::kMasses, MarginFamily::kZmpRobot},
      {Unknown::kFeet, MarginFamily::kJoint}};
  // A few for each robot. The right leg has the least margin in one of a few walks.
  const auto robot = std::find(kShippedRobots.begin(), kShippedRobots.end(), GetParam());
  for (auto k = static_cast<size_t>(robot - kShippedRobots.begin()); k < mistakes.size(); k += 3) {
    const auto& [unknown, family] = mistakes[k];
    std::vector<std::string> falsehoods;
    for (unsigned seed = kSeed; falsehoods.empty() && seed < kSeed + 8; ++seed) {
      const TemporaryFolder folder, other;
      const Judge judge(Write({.seed = seed}, folder),
                        Write({.seed = seed, .unknown = unknown}, other), 1e-9);
      judge.JudgeFamily(family, SceneKind::kMoving, seed, folder.path().string(), &falsehoods);
    }
    EXPECT_THAT(falsehoods, testing::Not(testing::IsEmpty())) << k;
  }
}

}  // namespace
}  // namespace halfstep::oracle
