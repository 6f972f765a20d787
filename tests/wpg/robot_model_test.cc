#include "wpg/robot/robot_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "tests/places.h"
#include "tests/replaced.h"
#include "tests/temporary_folder.h"
#include "tests/wpg/generated_robots.h"
#include "tests/wpg/shipped_robots.h"
#include "wpg/files/text.h"
#include "wpg/robot/acceleration_limits.h"
#include "wpg/robot/robot_fields.h"
#include "wpg/robot/sole_outline.h"
#include "wpg/robot/torque_limits.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::HasSubstr;

TEST(GeneratedRobot, LegsAreFoundInTheUrdf) {
  for (const GeneratedRobot& generated : GeneratedRobots()) {
    const RobotModel robot = TemporaryRobot(generated).Load();
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const Leg& leg = robot.legs[static_cast<size_t>(Index(side))];
      const Leg expected = MakeLeg(generated, side);
      EXPECT_LT((leg.hip_B - expected.hip_B).norm(), 1e-9) << generated.name;
      EXPECT_LT((leg.ankle_B - expected.ankle_B).norm(), 1e-9);
      EXPECT_LT((leg.X_BSole.matrix() - expected.X_BSole.matrix()).norm(), 1e-9);
      EXPECT_LT((leg.standing_q - expected.standing_q).norm(), 1e-9);
      EXPECT_EQ(leg.branch, expected.branch);
      for (size_t i = 0; i < 6; ++i) {
        EXPECT_LT((leg.joints[i].axis_B - expected.joints[i].axis_B).norm(), 1e-9);
        EXPECT_LT((leg.joints[i].X_BLink.matrix() - expected.joints[i].X_BLink.matrix()).norm(),
                  1e-9);
        EXPECT_NEAR(leg.joints[i].lower, expected.joints[i].lower, 1e-12);
      }
    }
    EXPECT_NEAR(robot.mass, 20 + 12 * 1.5, 1e-9);
    EXPECT_GT(robot.com_height, 0.3);
    EXPECT_EQ(robot.bodies.size(), 9u);
  }
}

TEST(GeneratedRobot, ShapesStandUprightAtZeroWhateverTheLinkFrames) {
  const RobotModel robot = TemporaryRobot(GeneratedRobots()[2]).Load();
  const Leg& leg = robot.legs[0];
  for (const RobotBody& body : robot.bodies) {
    if (body.name != "left_link3" && body.name != "left_link5") continue;
    const Isometry3d X_BLink = leg.joints[static_cast<size_t>(body.link)].X_BLink;
    const auto extent = [&](const Vector3d& d_B) {
      const Vector3d d = X_BLink.linear().transpose() * d_B;
      return Support(body.shape, d) + Support(body.shape, -d);
    };
    if (body.name == "left_link5") {
      EXPECT_NEAR(extent({1, 0, 0}), 0.2, 1e-9);
      EXPECT_NEAR(extent({0, 0, 1}), 0.04, 1e-9);
    } else {  // a tilted cylinder: a prism around it
      EXPECT_NEAR(extent({0, 0, 1}), 0.24, 1e-9);
      for (int k = 0; k < 100; ++k) {
        const double diameter = extent({std::cos(0.01 * k), std::sin(0.01 * k), 0});
        EXPECT_GE(diameter, 0.08 - 1e-12);
        EXPECT_LE(diameter, 0.08 * 1.005);
      }
    }
  }
}

TEST(GeneratedRobot, ExcludedPairsAreListedWithTheirReason) {
  const GeneratedRobot generated = GeneratedRobots()[0];
  const std::string yaml = GeneratedYaml(generated, "robot.urdf") +
                           "excluded_self_pairs:\n"
                           "  - {links: [waist, left_link2], why: padded}\n"
                           "  - {links: [right_link2, waist]}\n";
  const RobotModel robot = TemporaryRobot("excluded", GeneratedUrdf(generated), yaml).Load();
  std::map<std::string, std::string> why;
  for (const UnwatchedPair& pair : robot.unwatched_pairs) {
    why[robot.bodies[static_cast<size_t>(pair.b)].name] += pair.why + "; ";
  }
  EXPECT_EQ(why["left_link2"], "excluded by the robot file: padded; ");
  EXPECT_EQ(why["right_link2"], "excluded by the robot file; ");
}

TEST(GeneratedRobot, FixedJointsAreFoldedIn) {
  const GeneratedRobot generated = GeneratedRobots()[0];
  // A fixed link between waist and left hip, and a toe plate fixed on the left foot.
  std::string urdf =
      Replaced(GeneratedUrdf(generated), "<parent link='waist'/>", "<parent link='bracket'/>");
  urdf = Replaced(urdf, "</robot>",
                  "<link name='bracket'/><joint name='b' type='fixed'><parent link='waist'/><child "
                  "link='bracket'/></joint><link name='toe'><collision><geometry><sphere "
                  "radius='0.01'/></geometry></collision></link><joint name='t' type='fixed'>"
                  "<origin xyz='0.1 0 0'/><parent link='left_link5'/><child link='toe'/></joint>"
                  "</robot>");
  const RobotModel robot =
      TemporaryRobot("fixed", urdf, GeneratedYaml(generated, "robot.urdf")).Load();
  EXPECT_LT((robot.legs[0].hip_B - MakeLeg(generated, Side::kLeft).hip_B).norm(), 1e-9);
  const auto toe = std::find_if(robot.bodies.begin(), robot.bodies.end(),
                                [](const RobotBody& body) { return body.name == "toe"; });
  ASSERT_NE(toe, robot.bodies.end());
  EXPECT_EQ(toe->leg, 0);
  EXPECT_EQ(toe->link, 5);
  EXPECT_LT((toe->shape.center - Vector3d(0.1, 0, 0)).norm(), 1e-12);
}

// A foot whose box is replaced by another shape, which stands on the sole's plane.
RobotModel WithFoot(const std::string& geometry, double center_height) {
  const GeneratedRobot generated = GeneratedRobots()[0];
  std::string urdf = GeneratedUrdf(generated);
  for (const double side : {1.0, -1.0}) {
    const Vector3d at(generated.foot.x(), side * generated.foot.y(),
                      generated.foot.z() + center_height);
    const std::string size = "<box size='0.2 0.11 0.04'/>";
    const size_t end = urdf.find(size), begin = urdf.rfind("<collision>", end);
    urdf.replace(begin, end + size.size() - begin,
                 "<collision><origin xyz='" + generated::Text(at) + "'/><geometry>" + geometry);
  }
  return TemporaryRobot("foot", urdf, GeneratedYaml(generated, "robot.urdf")).Load();
}

TEST(GeneratedRobot, SoleOutlineHoldsEveryPointNearTheFloor) {
  // Larger than the sole rectangle of 0.2 × 0.11 m where the shape is.
  const auto reach = [](const RobotModel& robot) -> Eigen::Vector2d {
    return robot.sole_outline.rowwise().maxCoeff();
  };
  EXPECT_LT(
      (reach(WithFoot("<box size='0.24 0.1 0.04'/>", 0.02)) - Eigen::Vector2d(0.12, 0.055)).norm(),
      1e-12);
  EXPECT_LT(
      (reach(WithFoot("<box size='0.24 0.1 0.04'/>", 0.0211)) - Eigen::Vector2d(0.1, 0.055)).norm(),
      1e-12)
      << "a body 1.1 mm above the sole does not touch";
  EXPECT_NEAR(reach(WithFoot("<cylinder radius='0.15' length='0.04'/>", 0.02)).x(), 0.15, 2e-4);
  EXPECT_GE(reach(WithFoot("<cylinder radius='0.15' length='0.04'/>", 0.02)).y(), 0.15 - 1e-12);
  EXPECT_GE(reach(WithFoot("<sphere radius='0.15'/>", 0.15)).y(),
            std::sqrt(0.15 * 0.15 - 0.149 * 0.149));
}

TEST(RobotModel, TorqueLimitsAreTheEffortsOrTheRobotFiles) {
  EXPECT_EQ(ShippedRobot("bison").legs[0].joints[3].max_torque, 300.0);
  EXPECT_TRUE(std::isinf(LoadRobot(kHrp2).legs[0].joints[3].max_torque)) << "its efforts are 0";
  const GeneratedRobot robot = GeneratedRobots()[0];
  const std::string yaml = GeneratedYaml(robot, "robot.urdf") +
                           "effort_limits_n_m: {left_joint0: 12.5, left_joint1: none}\n";
  const RobotModel model = TemporaryRobot("efforts", GeneratedUrdf(robot), yaml).Load();
  EXPECT_EQ(model.legs[0].joints[0].max_torque, 12.5);
  EXPECT_TRUE(std::isinf(model.legs[0].joints[1].max_torque));
  EXPECT_EQ(model.legs[1].joints[0].max_torque, 100.0);
  EXPECT_THAT(model.warnings,
              testing::ElementsAre(testing::HasSubstr(
                  "the torque limit of right_joint0 by 87.5 N m, the torque limit of right_joint1, "
                  "which is known of one side only; each leg is taken as it is")));
  const std::string silent =
      Replaced(GeneratedUrdf(robot), "' effort='100'/>", "' effort='0'/>");  // the first joint's
  const RobotModel unknown =
      TemporaryRobot("silent", silent, GeneratedYaml(robot, "robot.urdf")).Load();
  EXPECT_EQ(JointsOfUnknownTorque(unknown).size(), 1u);
}

TEST(RobotModel, AccelerationLimitsAreTheRobotFiles) {
  for (const std::string& name : kShippedRobots) {
    EXPECT_FALSE(HasAccelerationLimits(ShippedRobot(name))) << name;
  }
  const GeneratedRobot robot = GeneratedRobots()[0];
  const std::string yaml = GeneratedYaml(robot, "robot.urdf"), urdf = GeneratedUrdf(robot);
  const std::string key = "acceleration_limits_rad_s2: ";
  const RobotModel model =
      TemporaryRobot("limited", urdf, yaml + key + "{left_joint0: 12.5, left_joint1: none}\n")
          .Load();
  EXPECT_TRUE(HasAccelerationLimits(model));
  EXPECT_EQ(model.legs[0].joints[0].max_acceleration, 12.5);
  EXPECT_TRUE(std::isinf(model.legs[0].joints[1].max_acceleration));
  EXPECT_TRUE(std::isinf(model.legs[1].joints[0].max_acceleration));
  EXPECT_THAT(model.warnings,
              testing::ElementsAre(testing::HasSubstr("the acceleration limit of right_joint0")));
  EXPECT_FALSE(HasAccelerationLimits(
      TemporaryRobot("unlimited", urdf, yaml + key + "{left_joint0: none}\n").Load()));
}

// Half as many vertices as its hulls have; the feet stand where they stood.
TEST(RobotModel, HullsWithTooManyVerticesBecomeSimplerOnesAroundThem) {
  const RobotModel whole = Hrp2();
  EXPECT_TRUE(whole.warnings.empty()) << "shipped hulls stay as they are";
  std::ifstream file(kHrp2);
  std::string yaml{std::istreambuf_iterator<char>(file), {}};
  yaml = Replaced(yaml, "name: hrp2", "name: hrp2\nhull_vertices: 24");
  const RobotModel simple = BuildRobot(kHrp2, yaml, ReadRobotFile(kHrp2, yaml));
  ASSERT_EQ(simple.bodies.size(), whole.bodies.size());
  double largest = 0;
  int simplified = 0;
  for (size_t b = 0; b < whole.bodies.size(); ++b) {
    const ConvexBody &before = whole.bodies[b].shape, &after = simple.bodies[b].shape;
    EXPECT_LE(after.vertices.cols(), 24);
    EXPECT_EQ(whole.bodies[b].mesh_vertices, 0);
    if (simple.bodies[b].mesh_vertices == 0) continue;
    ++simplified;
    EXPECT_EQ(simple.bodies[b].mesh_vertices, before.vertices.cols());
    largest = std::max(largest, simple.bodies[b].excess);
    for (int k = 0; k < 27; ++k) {
      if (k == 13) continue;
      const Vector3d d = Vector3d(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1).normalized();
      EXPECT_GE(Support(after, d), Support(before, d) - 1e-14);
      EXPECT_LE(Support(after, d), Support(before, d) + simple.bodies[b].excess + 1e-14);
    }
  }
  EXPECT_GT(simplified, 10);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    EXPECT_NEAR(DepthBelowSole(simple, side), DepthBelowSole(whole, side), 1e-12);
  }
  ASSERT_EQ(simple.warnings.size(), 1u);
  EXPECT_THAT(simple.warnings[0], HasSubstr(Formatted("at most %.2g mm larger", 1e3 * largest)));
}

// A package is looked for where ROS would, and above the URDF.
TEST(RobotModel, FindsAPackageAboveTheUrdf) {
  const GeneratedRobot good = GeneratedRobots()[0];
  const TemporaryFolder place;
  std::filesystem::create_directories(place / "p/meshes");
  std::filesystem::create_directories(place / "p/urdf");
  std::filesystem::copy_file(InSources("tests/fixtures/mesh/good/cube_triangles.dae"),
                             place / "p/meshes/ankle.dae");
  WriteText(place / "p/urdf/robot.urdf",
            Replaced(GeneratedUrdf(good), "<sphere radius='0.035'/>",
                     "<mesh filename='package://p/meshes/ankle.dae' scale='0.03 -0.03 0.03'/>"));
  WriteText(place / "p/urdf/robot.yaml", GeneratedYaml(good, "robot.urdf"));
  const RobotModel model = LoadRobot((place / "p/urdf/robot.yaml").string());
  const auto body = std::ranges::find(model.bodies, "left_link4", &RobotBody::name);
  ASSERT_NE(body, model.bodies.end());
  EXPECT_EQ(body->shape.vertices.cols(), 8);
  EXPECT_LT(body->shape.vertices.row(1).maxCoeff(), 1e-12);  // mirrored
}

}  // namespace
}  // namespace halfstep
