// Robots as they are built: frames that point elsewhere, legs that are not quite mirror images.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>
#include <string>

#include "tests/replaced.h"
#include "tests/wpg/hrp2.h"
#include "wpg/files/input_error.h"
#include "wpg/files/regular_file.h"
#include "wpg/files/yaml_fields.h"
#include "wpg/robot/robot_fields.h"

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

TEST(RobotAsBuilt, LegsMayDifferByATenthOfAMillimetre) {
  const std::string text = ReadYamlFile(kHrp2);
  EXPECT_THAT(Built(text, WithRightAnkleMoved(0)).warnings, IsEmpty());
  const RobotModel robot = Built(text, WithRightAnkleMoved(6.4e-6));
  EXPECT_THAT(robot.warnings,
              ElementsAre(HasSubstr("the right ankle is 0.0064 mm off the mirror image of the left "
                                    "one; each leg is taken as it is")));
  EXPECT_NEAR(robot.legs[1].ankle_B.x() - robot.legs[0].ankle_B.x(), 6.4e-6, 1e-12);
  try {
    Built(text, WithRightAnkleMoved(2e-4));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the right ankle is 0.2 mm off the mirror image"));
  }
}

TEST(RobotAsBuilt, APackageThatNothingNamesIsTold) {
  const std::string text = Replaced(ReadYamlFile(kHrp2), "packages: {", "packages: {gone: /no, ");
  EXPECT_THAT(Built(text, Hrp2Tree()).warnings,
              ElementsAre("hrp2: packages.gone: no collision mesh of the URDF is in it"));
}

}  // namespace
}  // namespace halfstep
