// What of a robot no certificate covers: limits that are none or placeholders, mass without bodies,
// pairs that are not watched.

#include "wpg/robot/not_covered.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "tests/places.h"
#include "tests/temporary_folder.h"
#include "tests/wpg/shipped_robots.h"
#include "wpg/robot/placeholder_limits.h"
#include "wpg/robot/robot_legs.h"

namespace halfstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kGravity = 9.81;
constexpr double kUnknown = std::numeric_limits<double>::infinity();

std::vector<std::string> SentencesOf(const RobotModel& robot, NotCoveredKind kind) {
  std::vector<std::string> sentences;
  for (const NotCovered& one : NotCoveredOf(robot)) {
    if (one.kind == kind) sentences.push_back(one.sentence);
  }
  return sentences;
}

// The robot with all its lengths `times` as long, of the same density and as strong and quick for
// its size.
RobotModel Scaled(RobotModel robot, double times) {
  for (Leg& leg : robot.legs) {
    leg.hip_B *= times;
    leg.ankle_B *= times;
    leg.X_BSole.translation() *= times;
    for (LegJoint& joint : leg.joints) {
      joint.point_B *= times;
      joint.X_BLink.translation() *= times;
      joint.max_torque *= std::pow(times, 4);
      joint.max_speed /= std::sqrt(times);
      joint.max_acceleration /= times;
    }
  }
  robot.sole_size *= times;
  robot.mass *= std::pow(times, 3);
  return robot;
}

TEST(PlaceholderLimits, NoneOfTheShippedRobotsHasOne) {
  for (const std::string& name : kShippedRobots) {
    EXPECT_THAT(PlaceholderLimits(ShippedRobot(name)), IsEmpty()) << name;
  }
}

TEST(PlaceholderLimits, AreToldWhateverTheRobotsSize) {
  RobotModel robot = ShippedRobot("bison");
  robot.legs[0].joints[3].max_torque = 1e9;
  robot.legs[0].joints[4].max_speed = 100.0;
  robot.legs[1].joints[5].max_torque = 3000.0;  // at an ankle, where a hip may give it
  robot.legs[1].joints[2].max_acceleration = 1e5;
  robot.legs[1].joints[0].lower = -M_PI;
  robot.legs[1].joints[0].upper = M_PI;
  for (const double times : {1.0, 0.03, 2.5}) {
    SCOPED_TRACE(times);
    std::vector<std::string> joints;
    for (const PlaceholderLimit& limit : PlaceholderLimits(Scaled(robot, times))) {
      joints.push_back(limit.joint);
    }
    const auto name = [&](size_t leg, size_t j) { return robot.legs[leg].joints[j].name; };
    EXPECT_THAT(joints, ElementsAre(name(0, 3), name(0, 4), name(1, 0), name(1, 2), name(1, 5)));
  }
  EXPECT_THAT(SentencesOf(robot, NotCoveredKind::kPlaceholder)[0],
              HasSubstr(": its torque limit of 1e+09 N m is "));
}

// The weight's arm is at most the sole's farthest corner; a hip's is about the leg's length.
TEST(PlaceholderLimits, TheWeightAsksOfHipsWhatItAsksOverTheLeg) {
  for (const std::string& name : kShippedRobots) {
    const RobotModel robot = ShippedRobot(name);
    const Leg& leg = robot.legs[0];
    const double of_leg = robot.mass * kGravity * LengthOfLeg(leg);
    double most = 0.0;
    for (size_t j = 0; j < 6; ++j) most = std::max(most, TorqueByWeight(robot, leg, j));
    EXPECT_GT(most, 0.8 * of_leg) << name;
    EXPECT_LT(most, 1.2 * of_leg) << name;
    EXPECT_LT(TorqueByWeight(robot, leg, 5), 0.4 * of_leg) << name;
  }
}

TEST(NotCovered, JointsOfUnknownTorqueAreToldWhereOthersAreKnown) {
  RobotModel robot = ShippedRobot("bison");
  EXPECT_THAT(SentencesOf(robot, NotCoveredKind::kLimit), IsEmpty());
  robot.legs[1].joints[3].max_torque = kUnknown;
  EXPECT_THAT(SentencesOf(robot, NotCoveredKind::kLimit),
              ElementsAre(HasSubstr(robot.legs[1].joints[3].name + ": its torque limit is not ")));
  for (Leg& leg : robot.legs) {
    for (LegJoint& joint : leg.joints) joint.max_torque = kUnknown;
  }
  EXPECT_THAT(SentencesOf(robot, NotCoveredKind::kLimit), IsEmpty()) << "the family says it";
}

// One link of bison loses its shape, as a URDF may have it; others that are rigid with it keep
// theirs.
TEST(NotCovered, SaysWhatPartOfTheMassHasNoBody) {
  const std::vector<std::string> shipped =
      SentencesOf(ShippedRobot("bison"), NotCoveredKind::kMass);
  ASSERT_EQ(shipped.size(), 1u);
  EXPECT_THAT(shipped[0], HasSubstr("what it touches: torso_yaw_link (2.29 kg), "));
  const TemporaryFolder place;
  std::filesystem::copy(InSources("wpg/robots"), place / "robots",
                        std::filesystem::copy_options::recursive);
  std::string urdf = ReadText(place / "robots/bison.urdf");
  const size_t begin = urdf.find("<collision>"), end = urdf.find("</collision>");
  const size_t name = urdf.rfind("<link name=\"", begin) + 12;
  const std::string link = urdf.substr(name, urdf.find('"', name) - name);
  const size_t mass = urdf.rfind("<mass value=\"", begin) + 13;
  const double bare = std::stod(urdf.substr(mass));
  WriteText(place / "robots/bison.urdf", urdf.erase(begin, end + 12 - begin));
  const RobotModel robot = LoadRobot((place / "robots/bison.yaml").string());
  const std::vector<std::string> told = SentencesOf(robot, NotCoveredKind::kMass);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NEAR(std::stod(told[0]) - std::stod(shipped[0]), 100.0 * bare / robot.mass, 0.1);
  EXPECT_THAT(told[0], HasSubstr(" % of the mass ("));
  EXPECT_THAT(told[0], HasSubstr("what it touches: " + link + " ("));
}

TEST(NotCovered, HasEveryPairThatIsNotWatchedWithItsReason) {
  const RobotModel robot = ShippedRobot("hrp2");
  const std::vector<std::string> told = SentencesOf(robot, NotCoveredKind::kPair);
  ASSERT_EQ(told.size(), robot.unwatched_pairs.size());
  for (size_t i = 0; i < told.size(); ++i) {
    EXPECT_THAT(told[i], testing::EndsWith(": not watched: " + robot.unwatched_pairs[i].why));
  }
}

TEST(NotCovered, ASummaryCountsKindsWithManyAndTellsTheOthersWhole) {
  std::vector<NotCovered> list = {NotDemandedFamily("torque", "masses are not known")};
  for (int i = 0; i < 7; ++i) {
    const std::string pair = "a" + std::to_string(i) + " - b";
    list.push_back({NotCoveredKind::kPair, pair, pair + ": not watched: joined by c"});
  }
  EXPECT_THAT(SummaryOf(list),
              ElementsAre("torque: nothing is demanded: masses are not known",
                          "7 pairs of bodies that are not watched: a0 - b, a1 - b, a2 - b and 4 "
                          "more"));
  EXPECT_THAT(NotCoveredText(list, "x", "# "), testing::StartsWith("# 8 things that "));
  EXPECT_EQ(NotCoveredText({}, "x"), "");
  for (const NotCovered& one : list) EXPECT_EQ(NotCoveredKindOf(Name(one.kind)), one.kind);
}

}  // namespace
}  // namespace halfstep
