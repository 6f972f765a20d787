// Robots as they are built: frames that point elsewhere, legs that are no mirror images.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include "tests/replaced.h"
#include "tests/wpg/hrp2.h"
#include "wpg/files/input_error.h"
#include "wpg/files/regular_file.h"
#include "wpg/files/yaml_fields.h"
#include "wpg/robot/robot_fields.h"
#include "wpg/robot/robot_legs.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

UrdfTree Hrp2Tree() {
  return ReadUrdf(std::filesystem::path(kHrp2).replace_extension("urdf").string());
}

// HRP-2 by another text of its file and another tree.
RobotModel Built(const std::string& text, const UrdfTree& urdf) {
  return BuildRobot(kHrp2, text, ReadRobotFile(kHrp2, text, &urdf));
}

// An angle iron of 40 x 10 x 40 cm, 5 cm thick, in place of the chest.
constexpr char kIron[] =
    "v 0 0 0\nv .4 0 0\nv .4 0 .05\nv .05 0 .05\nv .05 0 .4\nv 0 0 .4\n"
    "v 0 .1 0\nv .4 .1 0\nv .4 .1 .05\nv .05 .1 .05\nv .05 .1 .4\nv 0 .1 .4\n"
    "f 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n"
    "f 1 4 3 2\nf 1 6 5 4\nf 7 8 9 10\nf 7 10 11 12\n";

TEST(RobotAsBuilt, AMeshMayBeSeveralConvexParts) {
  const std::string mesh = testing::TempDir() + "halfstep_iron.obj";
  std::ofstream(mesh) << kIron;
  UrdfTree urdf = Hrp2Tree();
  auto& chest = urdf.links[static_cast<size_t>(urdf.FindLink("CHEST_LINK1"))];
  chest.collisions[0].mesh = "file://" + mesh;
  const std::string text = ReadYamlFile(kHrp2);
  const RobotModel whole = Built(text, urdf);
  const RobotModel cut = Built(text + "mesh_parts: {CHEST_LINK1: 4}\n", urdf);
  ASSERT_EQ(cut.bodies.size(), whole.bodies.size() + 1);
  std::vector<std::string> names;
  for (const RobotBody& body : cut.bodies) {
    if (body.name.starts_with("CHEST_LINK1")) {
      names.push_back(body.name);
      EXPECT_EQ(body.leg, -1);
      EXPECT_LT(body.shape.radius, 0.22);
    }
  }
  EXPECT_THAT(names, ElementsAre("CHEST_LINK1", "CHEST_LINK1#2"));
  EXPECT_EQ(cut.files.size(), whole.files.size()) << "the mesh is read once";
  EXPECT_GT(cut.self_pairs.size(), whole.self_pairs.size());
  std::filesystem::remove(mesh);
}

TEST(RobotAsBuilt, HalfStepsByDefaultAreNoHigherThanTheFileSays) {
  const std::string text = ReadYamlFile(kHrp2);
  const RobotModel free = Built(text, Hrp2Tree());
  const RobotModel low = Built(text + "lift_m: 0.1\n", Hrp2Tree());
  EXPECT_GT(MeasuresOf(free).lift, 0.2);
  EXPECT_EQ(MeasuresOf(low).lift, 0.1);
}

TEST(RobotAsBuilt, SupportPointsByDefaultAreWhereTheFileSays) {
  const std::string text = ReadYamlFile(kHrp2);
  EXPECT_EQ(MeasuresOf(Built(text, Hrp2Tree())).support_point, 0.0);
  const RobotModel outward = Built(text + "support_point_m: -0.011\n", Hrp2Tree());
  EXPECT_EQ(MeasuresOf(outward).support_point, -0.011);
}

TEST(RobotAsBuilt, TheWaistFrameMayPointAnywhereInItsLink) {
  const RobotModel expected = LoadRobot(kHrp2);
  UrdfTree urdf = Hrp2Tree();
  const std::vector<double> rpy = {0.3, -0.5, std::numbers::pi};
  urdf.TurnFrame(urdf.FindLink("WAIST"), RotationOf(rpy).transpose());
  const std::string text =
      Replaced(ReadYamlFile(kHrp2), "waist_link: WAIST",
               "waist_link: WAIST\nwaist_rpy_deg: [17.188733853924695, -28.64788975654116, 180]");
  const RobotModel turned = Built(text, urdf);
  EXPECT_NEAR(turned.com_x_B, expected.com_x_B, 1e-12);
  EXPECT_NEAR(turned.waist_height, expected.waist_height, 1e-12);
  ASSERT_EQ(turned.bodies.size(), expected.bodies.size());
  for (size_t i = 0; i < expected.bodies.size(); ++i) {
    const Eigen::Matrix3Xd& vertices = expected.bodies[i].shape.vertices;
    ASSERT_EQ(turned.bodies[i].shape.vertices.cols(), vertices.cols()) << expected.bodies[i].name;
    EXPECT_LT((turned.bodies[i].shape.vertices - vertices).norm(), 1e-9) << expected.bodies[i].name;
  }
  for (size_t leg = 0; leg < 2; ++leg) {
    for (size_t i = 0; i < 6; ++i) {
      const LegJoint &is = turned.legs[leg].joints[i], &was = expected.legs[leg].joints[i];
      EXPECT_LT((is.axis_B - was.axis_B).norm(), 1e-12) << was.name;
      EXPECT_LT((is.point_B - was.point_B).norm(), 1e-12) << was.name;
    }
  }
  // A control: without the key the robot's waist lies askew.
  EXPECT_THROW(Built(ReadYamlFile(kHrp2), urdf), InputError);
}

// HRP-2 with its right ankle moved along the leg.
UrdfTree WithRightAnkleMoved(double metres) {
  UrdfTree urdf = Hrp2Tree();
  for (UrdfJoint& joint : urdf.joints) {
    if (joint.name == "RLEG_JOINT4") joint.X_ParentChild.translation().x() += metres;
  }
  return urdf;
}

TEST(RobotAsBuilt, LegsMayDiffer) {
  const std::string text = ReadYamlFile(kHrp2);
  const RobotModel mirrored = Built(text, WithRightAnkleMoved(0));
  EXPECT_THAT(mirrored.warnings, IsEmpty());
  EXPECT_TRUE(mirrored.legs_are_mirrored);
  const RobotModel robot = Built(text, WithRightAnkleMoved(6.4e-6));
  EXPECT_THAT(robot.warnings,
              ElementsAre(HasSubstr("the right leg differs from the left one's mirror image: ankle "
                                    "by 0.0064 mm")));
  EXPECT_FALSE(robot.legs_are_mirrored);
  EXPECT_NEAR(robot.legs[1].ankle_B.x() - robot.legs[0].ankle_B.x(), 6.4e-6, 1e-12);
  // The posture of a file has to put both soles on one floor.
  try {
    Built(text, WithRightAnkleMoved(2e-4));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the soles do not stand side by side"));
  }
}

// Each difference is told with its size, and none where there is none.
TEST(RobotAsBuilt, DifferencesOfLegsHaveASize) {
  const RobotModel robot = Built(ReadYamlFile(kHrp2), Hrp2Tree());
  const auto differences = [&](const auto& change) {
    Leg right = robot.legs[1];
    change(&right.joints[3]);
    return MirrorDifferences(robot.legs[0], right, 1e-6);
  };
  EXPECT_THAT(differences([](LegJoint*) {}), IsEmpty());
  EXPECT_THAT(differences([](LegJoint* j) {
                j->axis_B = Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitZ()) * j->axis_B;
              }),
              ElementsAre("the axis of RLEG_JOINT3 by 0.573 deg"));
  EXPECT_THAT(differences([](LegJoint* j) { j->point_B.z() += 2e-3; }),
              ElementsAre("the place of RLEG_JOINT3 by 2.0 mm"));
  EXPECT_THAT(differences([](LegJoint* j) { j->upper += 0.1; }),
              ElementsAre("the limits of RLEG_JOINT3 by 5.73 deg"));
  EXPECT_THAT(differences([](LegJoint* j) { j->max_speed += 0.5; }),
              ElementsAre("the speed limit of RLEG_JOINT3 by 0.5 rad/s"));
  EXPECT_THAT(differences([](LegJoint* j) { j->max_torque = 200; }),
              ElementsAre("the torque limit of RLEG_JOINT3, which is known of one side only"));
}

// Such as Drake's note that a mesh is convex, beside the shape or before it.
TEST(RobotAsBuilt, ElementsOfOtherProgramsAreNoShapes) {
  std::stringstream urdf;
  urdf << std::ifstream(std::filesystem::path(kHrp2).replace_extension("urdf")).rdbuf();
  const std::string path = testing::TempDir() + "halfstep_foreign.urdf";
  std::ofstream(path) << Replaced(urdf.str(), "<geometry>", "<geometry><drake:declare_convex/>");
  const UrdfTree read = ReadUrdf(path), plain = Hrp2Tree();
  EXPECT_THAT(read.warnings, IsEmpty());
  ASSERT_EQ(read.links.size(), plain.links.size());
  for (size_t i = 0; i < plain.links.size(); ++i) {
    EXPECT_EQ(read.links[i].collisions.size(), plain.links[i].collisions.size());
  }
}

TEST(RobotAsBuilt, APackageThatNothingNamesIsTold) {
  const std::string text = Replaced(ReadYamlFile(kHrp2), "packages: {", "packages: {gone: /no, ");
  EXPECT_THAT(Built(text, Hrp2Tree()).warnings,
              ElementsAre("hrp2: packages.gone: no collision mesh of the URDF is in it"));
}

}  // namespace
}  // namespace halfstep
