// The one list of what a certificate does not speak of: no family can be forgotten by it.

#include "smoothing/margins/not_covered_by.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "smoothing/margins/family_traits.h"
#include "smoothing/margins/margin_evaluator.h"
#include "tests/wpg/hrp2.h"
#include "tests/wpg/joint_limits.h"
#include "wpg/robot/acceleration_limits.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;

std::vector<std::string> FamiliesIn(const std::vector<NotCovered>& list) {
  std::vector<std::string> families;
  for (const NotCovered& one : list) {
    if (one.kind == NotCoveredKind::kFamily) families.push_back(one.subject);
    EXPECT_THAT(one.sentence, testing::Not(testing::EndsWith(": "))) << "a reason is told";
  }
  return families;
}

// All margins of this robot can be demanded.
RobotModel KnownRobot() {
  RobotModel robot = WithTorqueLimits(Hrp2(), 200.0);
  robot.legs[0].joints[3].max_acceleration = 20.0;
  return robot;
}

TEST(NotCoveredBy, NamesEveryFamilyOfWhichNothingIsDemandedAndNoOther) {
  const RobotModel robot = KnownRobot();
  EXPECT_THAT(FamiliesIn(NotCoveredBy(robot, {}, {})), testing::IsEmpty());
  for (const MarginFamily family : FamiliesWith({})) {
    MarginLimits limits;
    limits.demanded_of(family) = kNotDemanded;
    if (Traits(family).coverage.on_request) {  // it is not missed where none asks
      EXPECT_THAT(FamiliesIn(NotCoveredBy(robot, {}, limits)), testing::IsEmpty());
      continue;
    }
    EXPECT_THAT(FamiliesIn(NotCoveredBy(robot, {}, limits)),
                testing::ElementsAre(std::string(Name(family))));
  }
}

// Whatever an evaluator leaves out of its demands, for masses or limits that no file states.
TEST(NotCoveredBy, NamesEveryFamilyThatARobotsFilesDoNotLetBeDemanded) {
  RobotModel robot = KnownRobot();
  robot.masses.fault = "the left leg has no mass";
  for (Leg& leg : robot.legs) {
    for (LegJoint& joint : leg.joints) joint.max_acceleration = kUnlimited;
  }
  const MarginEvaluator evaluator(robot, {}, {});
  std::vector<std::string> dropped;
  for (const MarginFamily family : AllMarginFamilies()) {
    if (Traits(family).coverage.on_request) continue;
    if (evaluator.limits().demanded_of(family) == kNotDemanded) {
      dropped.emplace_back(Name(family));
    }
  }
  EXPECT_EQ(dropped.size(), 4u);
  // Also when the config says `none` itself, with the robot's reason.
  for (const MarginLimits& limits : {MarginLimits{}, evaluator.limits()}) {
    const std::vector<NotCovered> list = NotCoveredBy(robot, {}, limits);
    EXPECT_EQ(FamiliesIn(list), dropped);
    EXPECT_EQ(list[0].sentence, "zmp_robot: nothing is demanded: the left leg has no mass");
  }
}

TEST(NotCoveredBy, NamesFeetWithoutLimitsAndFrictionThatIsAssumed) {
  MarginLimits limits;
  limits.foot_speed.reset();
  limits.foot_yaw_rate.reset();
  Scene scene;
  EXPECT_THAT(FamiliesIn(NotCoveredBy(KnownRobot(), scene, limits)),
              testing::ElementsAre("foot_speed", "foot_yaw_rate"));
  const auto of_friction = [&] {
    return std::ranges::count(NotCoveredBy(KnownRobot(), scene, limits), NotCoveredKind::kAssumed,
                              &NotCovered::kind);
  };
  EXPECT_EQ(of_friction(), 1);
  scene.friction = 0.5;
  EXPECT_EQ(of_friction(), 0);
  limits.demanded_of(MarginFamily::kFriction) = kNotDemanded;
  scene.friction = Scene{}.friction;
  EXPECT_EQ(of_friction(), 0) << "nothing is demanded of it";
}

TEST(NotCoveredBy, TellsAccelerationsThatAreAssumed) {
  const auto told = [](const RobotModel& robot, const MarginLimits& limits) {
    for (const NotCovered& one : NotCoveredBy(robot, {}, limits)) {
      if (one.subject == "joint_acceleration") return one;
    }
    return NotCovered{};
  };
  RobotModel robot = Hrp2();
  EXPECT_EQ(told(robot, {}).kind, NotCoveredKind::kFamily);
  AssumeAccelerationLimits(40.0, &robot);
  EXPECT_EQ(told(robot, {}).kind, NotCoveredKind::kAssumed);
  EXPECT_EQ(told(robot, {}).sentence,
            "limits of joint accelerations are assumed (40 rad/s²): the robot file states none");
  MarginLimits none;
  none.demanded_of(MarginFamily::kJointAcceleration) = kNotDemanded;
  EXPECT_EQ(told(robot, none).sentence,
            "joint_acceleration: nothing is demanded: the config says none");
  RobotModel known = KnownRobot();
  AssumeAccelerationLimits(40.0, &known);
  EXPECT_EQ(known.legs[0].joints[3].max_acceleration, 20.0);
  EXPECT_THAT(told(known, {}).sentence, testing::EndsWith("states none of 11 of 12 joints"));
}

TEST(NotCoveredBy, EndsWithWhatOfTheRobotNothingCovers) {
  const RobotModel robot = Hrp2();
  EXPECT_THAT(NotCoveredBy(robot, {}, {}), IsSupersetOf(NotCoveredOf(robot)));
}

}  // namespace
}  // namespace halfstep
