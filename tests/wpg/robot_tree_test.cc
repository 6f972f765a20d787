#include "wpg/robot/robot_tree.h"

#include <gtest/gtest.h>

#include "tests/temporary_folder.h"
#include "tests/wpg/hrp2.h"

namespace halfstep {
namespace {

TEST(RobotTree, HoldsEveryLinkAndTheStandingPosture) {
  const RobotTree tree = LoadWholeRobot(kHrp2).tree;
  const RobotModel robot = LoadRobot(kHrp2);
  double mass = 0.0;
  for (const UrdfLink& link : tree.urdf.links) {
    mass += link.mass;
    EXPECT_GT(link.inertia.determinant(), 0.0) << link.name;
  }
  EXPECT_NEAR(mass, robot.mass, 1e-12);
  const std::vector<int> joints = JointsInFileOrder(tree.urdf);
  ASSERT_EQ(joints.size(), 30u);
  const auto name = [&](int joint) { return tree.urdf.joints[static_cast<size_t>(joint)].name; };
  EXPECT_EQ(name(joints[0]), "CHEST_JOINT0");
  EXPECT_EQ(name(joints[4]), "RLEG_JOINT0");
  EXPECT_EQ(name(joints[29]), "LARM_JOINT6");
}

// The check of a URDF and urdfdom are two readings; where they saw different names, the second
// threw what is no InputError.
TEST(RobotTree, NamesAreUtf8WhateverTheFileSaysOfItsEncoding) {
  const std::string robot = R"(<robot name="r"><link name="a&#282;"/></robot>)";
  for (const std::string before :
       {"", "\xEF\xBB\xBF", R"(<?xml version="1.0" encoding="ISO-8859-1"?>)"}) {
    const UrdfTree tree = ParseUrdf("r.urdf", before + robot);
    ASSERT_EQ(tree.links.size(), 1u) << before;
    EXPECT_EQ(tree.links[0].name, "a\xC4\x9A") << before;
  }
}

TEST(RobotTree, JointAnglesAreTheLegsAndThePosture) {
  const RobotTree tree = LoadWholeRobot(kHrp2).tree;
  const RobotModel robot = LoadRobot(kHrp2);
  const std::vector<double> standing =
      JointAngles(robot, tree, {robot.legs[0].standing_q, robot.legs[1].standing_q});
  const std::vector<double> turned =
      JointAngles(robot, tree, {robot.legs[0].standing_q, Vector6d::Constant(0.5)});
  int differ = 0;
  for (size_t i = 0; i < standing.size(); ++i) {
    EXPECT_NEAR(standing[i], tree.posture[i], 1e-15);
    if (turned[i] != standing[i]) ++differ;
  }
  EXPECT_EQ(differ, 6);
}

// An inertia whose frame is turned by a quarter about z: x and y change places.
TEST(RobotTree, InertiaIsInTheLinksAxes) {
  const TemporaryFolder place;
  const std::string path = WriteText(place / "one.urdf", R"(<?xml version="1.0"?>
<robot name="one">
  <link name="body">
    <inertial>
      <origin xyz="0 0 0" rpy="0 0 1.5707963267948966"/>
      <mass value="2"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="2" iyz="0" izz="2.5"/>
    </inertial>
  </link>
</robot>
)");
  const UrdfTree tree = ReadUrdf(path);
  EXPECT_NEAR(tree.links[0].inertia(0, 0), 2.0, 1e-12);
  EXPECT_NEAR(tree.links[0].inertia(1, 1), 1.0, 1e-12);
  EXPECT_NEAR(tree.links[0].inertia(2, 2), 2.5, 1e-12);
}

}  // namespace
}  // namespace halfstep
