// Masses of the bodies that walking moves, and what is told about those of a URDF.

#include "wpg/robot/robot_masses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/places.h"
#include "tests/replaced.h"
#include "tests/wpg/generated_robots.h"
#include "tests/wpg/shipped_robots.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

// A generated robot in whose URDF the first `old_text` after `from` is another.
RobotModel LoadChanged(const std::string& from, const std::string& old_text,
                       const std::string& new_text) {
  const GeneratedRobot robot = GeneratedRobots()[0];
  std::string urdf = GeneratedUrdf(robot);
  const size_t at = urdf.find(old_text, urdf.find(from));
  EXPECT_NE(at, std::string::npos);
  urdf.replace(at, old_text.size(), new_text);
  return TemporaryRobot(robot.name, urdf, GeneratedYaml(robot, "robot.urdf")).Load();
}

TEST(RobotMasses, AreThoseOfAllLinks) {
  for (const std::string& name : kShippedRobots) {
    const WholeRobot whole = LoadWholeRobot(InSources("wpg/robots/") + name + ".yaml");
    const RobotModel& robot = whole.model;
    EXPECT_TRUE(robot.masses.known()) << robot.masses.fault;
    // In the standing posture: mass, centre and inertia about it, of the bodies and of all links.
    const auto X = whole.tree.urdf.LinkPoses(whole.tree.posture);
    const Eigen::Isometry3d X_BRoot = X[static_cast<size_t>(whole.tree.waist)].inverse();
    double mass[2] = {0, 0};
    Eigen::Vector3d moment[2] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    Eigen::Matrix3d inertia[2] = {Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};
    const auto add = [&](int k, double m, const Eigen::Vector3d& com, const Eigen::Matrix3d& I) {
      mass[k] += m;
      moment[k] += m * com;
      inertia[k] +=
          I + m * (com.squaredNorm() * Eigen::Matrix3d::Identity() - com * com.transpose());
    };
    for (size_t i = 0; i < X.size(); ++i) {
      const UrdfLink& link = whole.tree.urdf.links[i];
      const Eigen::Isometry3d X_BLink = X_BRoot * X[i];
      const Eigen::Matrix3d R = X_BLink.linear();
      add(0, link.mass, X_BLink * link.com, R * link.inertia * R.transpose());
    }
    add(1, robot.masses.waist.mass, robot.masses.waist.com, robot.masses.waist.inertia);
    for (size_t s = 0; s < 2; ++s) {
      const LegFrames frames = PlaceLeg(robot.legs[s], robot.legs[s].standing_q);
      for (size_t j = 0; j < 6; ++j) {
        const BodyMass& body = robot.masses.links[s][j];
        const Eigen::Isometry3d& X_BLink = frames.X_BLink[j];
        const Eigen::Matrix3d R = X_BLink.linear();
        add(1, body.mass, X_BLink * body.com, R * body.inertia * R.transpose());
      }
    }
    EXPECT_NEAR(mass[1], mass[0], 1e-12 * mass[0]) << name;
    EXPECT_LT((moment[1] - moment[0]).norm(), 1e-10 * mass[0]) << name;
    EXPECT_LT((inertia[1] - inertia[0]).norm(), 1e-10 * mass[0]) << name;
    EXPECT_THAT(robot.warnings, IsEmpty()) << name;
  }
}

TEST(RobotMasses, ALegWithoutMassIsNoRobotsLeg) {
  const GeneratedRobot robot = GeneratedRobots()[0];
  std::string urdf = GeneratedUrdf(robot);
  const std::string mass = "<mass value='" + std::to_string(1.5) + "'/>";
  for (size_t at = urdf.find("name='left_link0'"), k = 0; k < 6; ++k) {
    at = urdf.find(mass, at);
    ASSERT_NE(at, std::string::npos);
    urdf.replace(at, mass.size(), "<mass value='0'/>");
  }
  const RobotModel loaded =
      TemporaryRobot(robot.name, urdf, GeneratedYaml(robot, "robot.urdf")).Load();
  EXPECT_FALSE(loaded.masses.known());
  EXPECT_EQ(loaded.masses.fault, "the left leg has no mass");
}

TEST(RobotMasses, AnInertiaThatIsNotPositiveIsNoRobotsInertia) {
  const RobotModel robot = LoadChanged("name='left_link2'", "ixy='0'", "ixy='0.03'");
  EXPECT_THAT(robot.masses.fault,
              HasSubstr("link left_link2 has the negative moment of inertia -0.02 kg m²"));
}

// As of a public URDF's wrist of which one digit is wrong.
TEST(RobotMasses, ANegativeInertiaThatIsNegligibleIsToldOnly) {
  const GeneratedRobot good = GeneratedRobots()[0];
  const std::string wrist =
      "<link name='wrist'><inertial><mass value='0.01'/><inertia ixx='1e-9' iyy='1e-9' izz='1e-9' "
      "ixy='3e-9' ixz='0' iyz='0'/></inertial></link><joint name='hold' type='fixed'>"
      "<parent link='waist'/><child link='wrist'/></joint></robot>";
  const RobotModel robot = TemporaryRobot("wrist", Replaced(GeneratedUrdf(good), "</robot>", wrist),
                                          GeneratedYaml(good, "robot.urdf"))
                               .Load();
  EXPECT_TRUE(robot.masses.known()) << robot.masses.fault;
  EXPECT_THAT(robot.warnings, testing::Contains(HasSubstr("no rigid body has such an inertia")));
}

// As of a public URDF's lower leg, whose moments are zeros that were rounded.
TEST(RobotMasses, APointMassMayHaveARoundedZeroForAMoment) {
  const std::string right = "ixx='0.01' ixy='0' ixz='0' iyy='0.01' iyz='0' izz='0.01'";
  const RobotModel robot = LoadChanged("name='left_link2'", right,
                                       "ixx='1e-18' ixy='5e-20' ixz='0' iyy='0' iyz='0' izz='0'");
  EXPECT_TRUE(robot.masses.known()) << robot.masses.fault;
  const RobotModel wrong = LoadChanged("name='left_link2'", right,
                                       "ixx='1e-9' ixy='5e-9' ixz='0' iyy='0' iyz='0' izz='0'");
  EXPECT_THAT(wrong.masses.fault, HasSubstr("negative moment of inertia -4.525e-09"));
}

// As of a public URDF whose inertias are in another unit.
TEST(RobotMasses, AnInertiaBeyondTheRobotsReachIsNoRobotsInertia) {
  const RobotModel robot = LoadChanged("name='left_link2'", "izz='0.01'", "izz='1000'");
  EXPECT_THAT(robot.masses.fault, HasSubstr("the left leg has 9 kg and a moment of inertia of"));
}

TEST(RobotMasses, WhatIsHardToBelieveIsTold) {
  EXPECT_THAT(LoadChanged("name='left_link2'", "ixx='0.01'", "ixx='0.03'").warnings,
              testing::Contains(HasSubstr(
                  ": left_link2: the moment of inertia 0.03 kg m² exceeds the sum of the two "
                  "others, 0.02: no rigid body has such an inertia")));
  EXPECT_THAT(LoadChanged("name='left_link2'", "<mass value='1.5", "<mass value='150.5").warnings,
              testing::Contains(HasSubstr(": left_link2: the mass of 150.5 kg in the boxes around "
                                          "its collision shapes is a density of 1.22e+05 kg/m³")));
  EXPECT_THAT(LoadChanged("name='left_link2'", "ixx='0.01'", "ixx='0.0199'").warnings, IsEmpty());
}

}  // namespace
}  // namespace halfstep
