// Surfaces that no sole fits on: what is said of them holds, and is said where it does. Ramps.

#include "experiments/run/narrow_surfaces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "experiments/run/sloping_tops.h"
#include "planner/ground/level_ground.h"
#include "tests/wpg/shipped_robots.h"
#include "wpg/files/text.h"
#include "wpg/geometry/rotation.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kFoothold = 0.005;

LevelSurface Rectangle(const std::string& name, double x, double y, double wide, double long_,
                       double height) {
  LevelSurface surface;
  surface.name = name;
  surface.polygon =
      (Eigen::Matrix2Xd(2, 4) << x, x + wide, x + wide, x, y, y, y + long_, y + long_).finished();
  surface.height = height;
  surface.bottom = 0.0;
  return surface;
}

std::vector<std::string> Said(const std::vector<LevelSurface>& surfaces,
                              const RobotModel& robot = ShippedRobot("hrp2")) {
  const Eigen::AlignedBox2d area(Eigen::Vector2d(-10, -10), Eigen::Vector2d(10, 10));
  return NarrowSurfaces(robot, LevelGround(surfaces, true), kFoothold, area);
}

TEST(NarrowSurfaces, NamesTreadsThatAreShorterThanASole) {
  std::vector<LevelSurface> treads = {Rectangle("one", 0.0, -1, 0.24, 2, 0.1),
                                      Rectangle("two", 0.24, -1, 0.24, 2, 0.2)};
  const auto said = Said(treads);
  ASSERT_THAT(said, SizeIs(1));
  EXPECT_THAT(said.front(), HasSubstr("no sole that points across fits on one and two: they are "
                                      "0.240 m along the shorter way, and a sole needs 0.252 m"));
  EXPECT_THAT(Said({Rectangle("deep", 0.0, -1, 0.28, 2, 0.1)}), IsEmpty());
  // Of one level they bear a sole together.
  treads[1].height = 0.1;
  EXPECT_THAT(Said(treads), IsEmpty());
  const auto block = Said({Rectangle("block", 0.0, 0.0, 0.2, 0.2, 0.1)});
  ASSERT_THAT(block, SizeIs(1));
  EXPECT_THAT(block.front(), HasSubstr("no sole fits on block, however it is turned: it is 0.200"));
}

TEST(NarrowSurfaces, SaysNothingOfWhatIsElsewhere) {
  const LevelGround ground({Rectangle("narrow", 0.0, -1, 0.1, 2, 0.1)}, true);
  const Eigen::AlignedBox2d area(Eigen::Vector2d(1, 1), Eigen::Vector2d(2, 2));
  EXPECT_THAT(NarrowSurfaces(ShippedRobot("hrp2"), ground, kFoothold, area), IsEmpty());
}

// On a strip a sole fits when it is no wider across it.
TEST(NarrowSurfaces, SayByHowMuchASoleIsTurnedAndNoMore) {
  const RobotModel robot = ShippedRobot("hrp2");
  const auto width_of_sole = [&](double angle) {
    const Eigen::RowVectorXd along =
        Eigen::RowVector2d(std::cos(angle), std::sin(angle)) * robot.sole_outline;
    return along.maxCoeff() - along.minCoeff();
  };
  for (double width = 0.13; width < 0.25; width += 0.0071) {
    const auto said = Said({Rectangle("strip", 0.0, -2, width, 4, 0.1)}, robot);
    int least = 0;  // [°] at which it fits
    while (least <= 90 && width_of_sole(least * std::numbers::pi / 180.0) + 2 * kFoothold > width) {
      ++least;
    }
    ASSERT_THAT(said, SizeIs(1)) << width;
    if (least > 90) {
      EXPECT_THAT(said.front(), HasSubstr("however it is turned")) << width;
      continue;
    }
    const size_t at = said.front().find("more than ");
    ASSERT_NE(at, std::string::npos) << said.front() << " at " << width;
    const int told = std::stoi(said.front().substr(at + 10));
    EXPECT_LE(told, least) << width;
    EXPECT_GE(told, least - 3) << width;
  }
}

// A box of 1.2 x 2 x 0.1 m turned about y, the lower edge of its top at z = `lowest`.
Scene WithRamp(double degrees, double lowest) {
  const double angle = degrees * std::numbers::pi / 180.0;
  Obstacle ramp{.name = "ramp", .shape = Box{{1.2, 2.0, 0.1}}};
  ramp.X_WO.linear() = AxisRotation(-angle, Eigen::Vector3d::UnitY());
  const Eigen::Vector3d edge = ramp.X_WO.linear() * Eigen::Vector3d(-0.6, 0, 0.05);
  ramp.X_WO.translation() = Eigen::Vector3d(1, 0, lowest - edge.z());
  Scene scene;
  scene.obstacles = {ramp};
  return scene;
}

TEST(SlopingTops, AreThoseOfRamps) {
  const RobotModel robot = ShippedRobot("hrp2");
  const Eigen::AlignedBox2d area(Eigen::Vector2d(-1, -1), Eigen::Vector2d(3, 1)),
      elsewhere(Eigen::Vector2d(-1, -1), Eigen::Vector2d(0.2, 1));
  const auto said = SlopingTops(robot, WithRamp(10.0, 0.01), area);
  ASSERT_THAT(said, SizeIs(1));
  EXPECT_EQ(said.front(), "'ramp' slopes by 10 deg, and soles stand on level surfaces only");
  EXPECT_THAT(SlopingTops(robot, WithRamp(10.0, 0.01), elsewhere), IsEmpty());
  EXPECT_THAT(SlopingTops(robot, WithRamp(1.0, 0.01), area), IsEmpty());   // as good as level
  EXPECT_THAT(SlopingTops(robot, WithRamp(50.0, 0.01), area), IsEmpty());  // a wall that leans
  EXPECT_THAT(SlopingTops(robot, WithRamp(10.0, 0.8), area), IsEmpty());   // a desk
  // A wedge: its underside is level.
  Scene wedge = WithRamp(10.0, 0.0);
  TriangleMesh mesh;
  mesh.vertices.resize(3, 6);
  mesh.vertices << 0, 1, 1, 0, 1, 1, -1, -1, -1, 1, 1, 1, 0, 0, 0.2, 0, 0, 0.2;
  mesh.triangles.resize(3, 4);
  mesh.triangles << 0, 0, 0, 0, 2, 5, 1, 4, 5, 3, 4, 3;
  wedge.obstacles.front().shape = mesh;
  wedge.obstacles.front().X_WO = Eigen::Isometry3d::Identity();
  ASSERT_THAT(SlopingTops(robot, wedge, area), SizeIs(1));
  EXPECT_THAT(SlopingTops(robot, wedge, area).front(), HasSubstr("slopes by 11.3 deg"));
}

}  // namespace
}  // namespace halfstep
