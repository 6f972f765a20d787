// Robots that are refused, and with which words.

#include "wpg/robot/robot_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/fixture_check.h"
#include "tests/patterns.h"
#include "tests/replaced.h"
#include "tests/wpg/generated_robots.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

// All complaints of a robot, or "" when it is accepted.
std::string RefusalOf(const TemporaryRobot& robot) {
  try {
    (void)robot.Load();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string RefusalOf(const GeneratedRobot& robot) { return RefusalOf(TemporaryRobot(robot)); }

TEST(RobotRefusal, JointLimitsMoreThanATurnApart) {
  const GeneratedRobot robot = GeneratedRobots()[0];
  const std::string yaml = GeneratedYaml(robot, "robot.urdf");
  const auto with_limits = [&](const std::string& limit) {
    const std::string lower =
        AllReplaced(GeneratedUrdf(robot), "lower='[^']*'", "lower='-" + limit + "'");
    return AllReplaced(lower, "upper='[^']*'", "upper='" + limit + "'");
  };
  EXPECT_THAT(RefusalOf({"wide", with_limits("3.2"), yaml}),
              HasSubstr("left_joint0: its limits are more than a turn apart (valid: at most 360 "));
  EXPECT_NO_THROW((void)TemporaryRobot("turn", with_limits("3.14159"), yaml).Load());
  std::string narrowed = yaml + "joint_limits_deg:\n";
  for (const std::string side : {"left", "right"}) {
    for (int i = 0; i < 6; ++i) {
      narrowed += "  " + side + "_joint" + std::to_string(i) + ": [-180, 180]\n";
    }
  }
  EXPECT_NO_THROW((void)TemporaryRobot("narrowed", with_limits("3.2"), narrowed).Load());
}

// Offset axes are moved with a proof that needs a posture to begin with.
TEST(RobotRefusal, OffsetAxesOfANearlyStretchedLeg) {
  GeneratedRobot robot = OffsetRobots()[0];
  std::string yaml = GeneratedYaml(robot, "robot.urdf");
  const std::string urdf = GeneratedUrdf(robot);
  yaml = yaml.substr(0, yaml.find("standing_posture_deg"));
  yaml += "standing_posture_deg: {";
  for (const std::string side : {"left", "right"}) {
    const std::string joint = (side == "left" ? "" : ", ") + side + "_joint";
    yaml += joint + "2: -9.2, " + side + "_joint3: 2.4, " + side + "_joint4: 6.8";
  }
  const std::string refusal = RefusalOf({"stretched", urdf, yaml + "}\n"});
  EXPECT_THAT(refusal, HasSubstr("left_joint2: hip axes left_joint0 and left_joint2 pass each "
                                 "other at 50.0 mm, hip axes left_joint1 and left_joint2 pass each "
                                 "other at 66.0 mm; so there is no closed form for the leg's "
                                 "joints, and in the standing posture it is too near to a "
                                 "singularity for a proof without: bend it more there"));
}

TEST(RobotRefusal, LegsThatAreNoClosedFormLegs) {
  const GeneratedRobot good = GeneratedRobots()[0];
  const std::string urdf = GeneratedUrdf(good), yaml = GeneratedYaml(good, "robot.urdf");
  EXPECT_EQ(RefusalOf(good), "");
  const auto with_axis = [&](const std::string& child, const std::string& axis) {
    const size_t at = urdf.find("<axis", urdf.find("<child link='" + child + "'/>"));
    std::string changed = urdf;
    changed.replace(at, urdf.find("/>", at) - at, "<axis xyz='" + axis + "'");
    return RefusalOf({"axis", changed, yaml});
  };
  EXPECT_THAT(with_axis("left_link5", "0 1 0"),
              HasSubstr("ankle axes left_joint4 and left_joint5 are parallel"));
  EXPECT_THAT(with_axis("left_link1", "1 0 0"),
              HasSubstr("hip axes left_joint0 and left_joint1 are parallel"));
  const Vector3d to_ankle = good.shank.normalized();
  EXPECT_THAT(with_axis("left_link3", generated::Text(to_ankle)),
              HasSubstr("the knee axis passes the ankle at"));
  EXPECT_THAT(RefusalOf({"five", Replaced(urdf, "type='revolute'", "type='fixed'"),
                         Replaced(yaml, "  left_joint0:", "#")}),
              HasSubstr("left_link5: is 5 revolute joints away from the waist (valid: 6)"));
  EXPECT_THAT(
      RefusalOf({"foot", urdf, Replaced(yaml, "waist_link: waist", "waist_link: right_link0")}),
      HasSubstr("left_link5: does not hang on right_link0"));
  EXPECT_THAT(
      RefusalOf({"mesh",
                 Replaced(urdf, "<sphere radius='0.035'/>", "<mesh filename='http://ankle.stl'/>"),
                 yaml}),
      HasSubstr("left_link4: http://ankle.stl is no mesh path"));
  EXPECT_THAT(RefusalOf({"package",
                         Replaced(urdf, "<sphere radius='0.035'/>",
                                  "<mesh filename='package://p/ankle.stl'/>"),
                         yaml}),
              HasSubstr("left_link4: package `p` of package://p/ankle.stl has no folder"));
}

TEST(RobotRefusal, BodiesThatReachTooFar) {
  const GeneratedRobot good = GeneratedRobots()[0];
  const std::string urdf =
      Replaced(GeneratedUrdf(good), "<sphere radius='0.035'/>", "<sphere radius='35'/>");
  EXPECT_THAT(RefusalOf({"far", urdf, GeneratedYaml(good, "robot.urdf")}),
              HasSubstr("left_link4: reaches 35 m from its link, farther than a robot of this size "
                        "does (valid: at most "));
}

TEST(RobotRefusal, StretchedStandingPosture) {
  const GeneratedRobot good = GeneratedRobots()[0];
  std::string yaml = GeneratedYaml(good, "robot.urdf");
  yaml.erase(yaml.find("standing_posture_deg"));
  GeneratedRobot straight = good;
  straight.thigh = {0, 0, -0.3};
  straight.shank = {0, 0, -0.3};
  const std::string refusal =
      RefusalOf({"straight", GeneratedUrdf(straight), GeneratedYaml(straight, "robot.urdf")});
  EXPECT_EQ(refusal, "");
  EXPECT_THAT(RefusalOf({"straight", GeneratedUrdf(straight), yaml}), HasSubstr("singular"));
}

TEST(RobotRefusal, MissingUrdf) {
  const TemporaryRobot robot("gone", "", GeneratedYaml(GeneratedRobots()[0], "gone.urdf"));
  EXPECT_THAT(RefusalOf(robot), HasSubstr("gone.urdf: cannot be opened: No such file"));
}

class RobotFixture : public testing::TestWithParam<std::string> {};

TEST_P(RobotFixture, IsRefusedWithItsComplaints) { CheckFixture(GetParam(), LoadRobot); }

INSTANTIATE_TEST_SUITE_P(Yaml, RobotFixture, testing::ValuesIn(Fixtures("robot")), FixtureName);

// What no leg needs is a warning; the same in a leg is refused.
TEST(RobotRefusal, AJointThatCannotMoveMattersInALegOnly) {
  const GeneratedRobot good = GeneratedRobots()[0];
  const std::string yaml = GeneratedYaml(good, "robot.urdf");
  std::string finger;
  for (const std::string name : {"thumb", "index", "ring"}) {
    finger += "<link name='" + name + "'/><joint name='move_" + name +
              "' type='revolute'><parent link='waist'/><child link='" + name +
              "'/><limit lower='0' upper='1' velocity='0' effort='1'/></joint>";
  }
  finger += "</robot>";
  const TemporaryRobot robot("finger", Replaced(GeneratedUrdf(good), "</robot>", finger), yaml);
  const RobotModel model = robot.Load();
  ASSERT_EQ(model.warnings.size(), 1u) << testing::PrintToString(model.warnings);
  EXPECT_THAT(model.warnings[0],
              HasSubstr("limit velocity: 0 is out of range (valid: > 0); it is held still, so are "
                        "move_ring, move_thumb"));
  EXPECT_THAT(
      RefusalOf({"leg", Replaced(GeneratedUrdf(good), "velocity='4'", "velocity='0'"), yaml}),
      HasSubstr("limit velocity: 0 is out of range (valid: > 0)"));
}

}  // namespace
}  // namespace halfstep
