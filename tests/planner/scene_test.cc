#include "planner/scene/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <variant>

#include "planner/collision/separation.h"
#include "tests/fixture_check.h"
#include "tests/places.h"
#include "wpg/files/input_error.h"
#include "wpg/geometry/simple_polygon.h"

namespace halfstep {
namespace {

using ::testing::HasSubstr;

// A scene file (and a mesh beside it) in a folder of this test's own.
class SceneTest : public testing::Test {
 protected:
  SceneTest()
      : folder_(std::filesystem::temp_directory_path() /
                ("halfstep_scene_test_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~SceneTest() override { std::filesystem::remove_all(folder_); }

  std::string Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }

 private:
  const std::filesystem::path folder_;
};

TEST_F(SceneTest, ReadsEveryShape) {
  Write("table.obj", "v 0 0 0\nv 10 0 0\nv 0 10 0\nf 1 2 3\n");
  const Scene scene = LoadScene(Write("room.yaml", R"(
obstacles:
  - name: bar
    box: {size_m: [0.08, 2.0, 0.06]}
    pose: {xyz: [0.4, 0, 0.04], rpy_deg: [0, 0, 90]}
  - {name: post, cylinder: {radius_m: 0.03, length_m: 0.5}, pose: {xyz: [1, 0, 0.25]}}
  - {name: ball, sphere: {radius_m: 0.1}}
  - {name: rail, capsule: {radius_m: 0.01, length_m: 1.0}}
  - {name: table, mesh: {file: table.obj, scale: 0.1}}
)"));
  EXPECT_EQ(scene.name, "room");
  ASSERT_EQ(scene.obstacles.size(), 5u);
  EXPECT_EQ(scene.obstacles[0].name, "bar");

  const auto support = [&scene](size_t i, const Eigen::Vector3d& direction) {
    return Support(CollisionShape(scene.obstacles[i].shape).convex(), direction);
  };
  EXPECT_NEAR(support(0, Eigen::Vector3d::UnitX()), 0.04, 1e-15);
  EXPECT_NEAR(support(0, Eigen::Vector3d::UnitY()), 1.0, 1e-15);
  EXPECT_NEAR(support(0, Eigen::Vector3d::UnitZ()), 0.03, 1e-15);
  EXPECT_NEAR(support(1, Eigen::Vector3d::UnitX()), 0.03, 1e-15);
  EXPECT_NEAR(support(1, Eigen::Vector3d::UnitZ()), 0.25, 1e-15);
  EXPECT_NEAR(support(2, Eigen::Vector3d::UnitY()), 0.1, 1e-15);
  EXPECT_NEAR(support(3, Eigen::Vector3d::UnitZ()), 0.51, 1e-15);
  EXPECT_TRUE(std::holds_alternative<Box>(scene.obstacles[0].shape));
  EXPECT_TRUE(std::holds_alternative<Cylinder>(scene.obstacles[1].shape));
  EXPECT_TRUE(std::holds_alternative<Sphere>(scene.obstacles[2].shape));
  EXPECT_TRUE(std::holds_alternative<Capsule>(scene.obstacles[3].shape));
  const auto& mesh = std::get<TriangleMesh>(scene.obstacles[4].shape);
  ASSERT_EQ(mesh.triangles.cols(), 1);
  EXPECT_NEAR(mesh.vertices.maxCoeff(), 1.0, 1e-6);
  EXPECT_TRUE(scene.obstacles[2].X_WO.isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_TRUE((scene.obstacles[0].X_WO * Eigen::Vector3d::UnitX())
                  .isApprox(Eigen::Vector3d(0.4, 1.0, 0.04), 1e-12));
}

// 300 points of a ball of 1 m.
std::string BallOfPoints() {
  std::ostringstream text;
  text.precision(17);
  for (int i = 0; i < 300; ++i) {
    const double z = -1 + (2 * i + 1) / 300.0, r = std::sqrt(1 - z * z);
    text << "v " << r * std::cos(2.4 * i) << ' ' << r * std::sin(2.4 * i) << ' ' << z << '\n';
  }
  for (int i = 1; i + 2 <= 300; ++i) text << "f " << i << ' ' << i + 1 << ' ' << i + 2 << '\n';
  return text.str();
}

// What another program shows upright would lie on its side without a word.
TEST_F(SceneTest, WhatADaeCallsUpIsToldAndAppliedWhenAsked) {
  std::ifstream file(InSources("tests/fixtures/mesh/good/cube_triangles.dae"));
  std::string dae((std::istreambuf_iterator<char>(file)), {});
  dae.insert(dae.find('>', dae.find("<COLLADA")) + 1, "<asset><up_axis>Y_UP</up_axis></asset>");
  Write("cube.dae", dae);
  const auto load = [&](const std::string& keys) {
    return LoadScene(Write(
        "up.yaml", "obstacles: [{name: cube, mesh: {file: cube.dae, scale: 0.1" + keys + "}}]"));
  };
  const auto highest = [](const Scene& scene) {
    return std::get<TriangleMesh>(scene.obstacles[0].shape).vertices.rowwise().maxCoeff().eval();
  };
  const Scene taken = load(", dae_up_axis: ignored"), turned = load(", dae_up_axis: applied");
  ASSERT_EQ(taken.warnings.size(), 1u);
  EXPECT_THAT(taken.warnings[0], HasSubstr("obstacle cube: its file calls y up, and that turns "
                                           "nothing: its z is the scene's z"));
  EXPECT_TRUE(highest(taken).isApprox(Eigen::Vector3d(0.1, 0.1, 0.1)));
  EXPECT_TRUE(turned.warnings.empty());
  EXPECT_TRUE((highest(turned) - Eigen::Vector3d(0.1, 0.0, 0.1)).isZero(1e-12));
}

TEST_F(SceneTest, AMeshIsItsHullOrASimplerBodyAroundItWhenAsked) {
  Write("ball.obj", BallOfPoints());
  const auto load = [&](const std::string& vertices) {
    return LoadScene(Write("hulls.yaml",
                           "obstacles: [{name: rock, mesh: {file: ball.obj, "
                           "scale: 0.5, hull_vertices: " +
                               vertices + "}}]"));
  };
  EXPECT_TRUE(std::holds_alternative<TriangleMesh>(load("0").obstacles[0].shape));
  const Scene whole = load("1000");
  EXPECT_TRUE(whole.warnings.empty());
  const auto& hull = std::get<ConvexBody>(whole.obstacles[0].shape);
  EXPECT_EQ(hull.vertices.cols(), 300);
  const Scene simple = load("32");
  const auto& around = std::get<ConvexBody>(simple.obstacles[0].shape);
  EXPECT_LE(around.vertices.cols(), 32);
  for (const Eigen::Vector3d& v : hull.vertices.colwise()) {
    const Eigen::Vector3d d = v.normalized();
    EXPECT_GE(Support(around, d), Support(hull, d) - 1e-15);
    EXPECT_LE(Support(around, d), Support(hull, d) + 0.1);
  }
  ASSERT_EQ(simple.warnings.size(), 1u);
  EXPECT_THAT(simple.warnings[0],
              testing::ContainsRegex("hulls.yaml: obstacle rock: the hull of the mesh has 300 "
                                     "vertices; a simpler one around it, with [23].*, is at most "
                                     "[1-9].* mm larger"));
  try {
    load("10");
    FAIL() << "10 vertices";
  } catch (const InputError& error) {
    EXPECT_THAT(error.complaints()[0], testing::HasSubstr("hull_vertices: 10 are too few (valid: "
                                                          "0, or at least 24)"));
  }
}

TEST_F(SceneTest, TurnsAboutFixedAxesXThenYThenZ) {
  const Scene scene = LoadScene(Write("turned.yaml", R"(
name: turned
obstacles: [{name: a, sphere: {radius_m: 1}, pose: {rpy_deg: [90, 0, 90]}}]
)"));
  EXPECT_EQ(scene.name, "turned");
  // y goes to z by the turn about x and stays there; z goes to -y, then to x.
  const Eigen::Matrix3d R = scene.obstacles[0].X_WO.linear();
  EXPECT_TRUE((R * Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
  EXPECT_TRUE((R * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX(), 1e-12));
}

TEST_F(SceneTest, ReadsMotion) {
  const Scene scene = LoadScene(Write("moving.yaml", R"(
obstacles:
  - name: cart
    box: {size_m: [0.4, 0.4, 0.4]}
    pose: {xyz: [1, 2, 0.2]}
    motion:
      waypoints:
        - {t_s: 2.0, xyz: [1, 0, 0.2]}
        - {t_s: 2.5, xyz: [0, 0, 0.2], yaw_deg: -90}
      error_m: 0.01
      speed_m_s: 0.2
      measured_at_s: -0.5
      horizon_s: 2.5
  - {name: known, sphere: {radius_m: 1}, motion: {error_m: 0.02}}
  - {name: still, sphere: {radius_m: 1}}
)"));
  const ObstacleMotion& cart = scene.obstacles[0].motion;
  ASSERT_EQ(cart.waypoints.size(), 2u);
  EXPECT_EQ(cart.waypoints[0].t, 2.0);
  EXPECT_EQ(cart.waypoints[0].translation, Eigen::Vector3d(1, 0, 0.2));
  EXPECT_EQ(cart.waypoints[0].yaw, 0.0);
  EXPECT_NEAR(cart.waypoints[1].yaw, -1.5707963267948966, 1e-15);
  EXPECT_EQ(cart.error, 0.01);
  EXPECT_EQ(cart.speed, 0.2);
  EXPECT_EQ(cart.measured_at, -0.5);
  EXPECT_EQ(cart.horizon, 2.5);
  EXPECT_FALSE(scene.rests());
  // What is only known within an error rests all the same.
  EXPECT_EQ(scene.obstacles[1].motion.error, 0.02);
  EXPECT_EQ(scene.obstacles[1].motion.horizon, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(scene.obstacles[1].rests());
  EXPECT_TRUE(scene.obstacles[2].rests());
}

TEST_F(SceneTest, RefusesMoreWaypointsThanItWouldSearch) {
  std::string text =
      "obstacles:\n  - name: cart\n    sphere: {radius_m: 1}\n    motion:\n      waypoints:\n";
  for (int i = 1; i <= 10001; ++i) {
    text += "        - {t_s: " + std::to_string(i) + ", xyz: [0, 0, 0]}\n";
  }
  try {
    (void)LoadScene(Write("many.yaml", text));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(":5:7: obstacles[0].motion.waypoints: 10001"));
  }
}

TEST_F(SceneTest, TurnsNoStepPolygonsCounterClockwise) {
  const Scene scene = LoadScene(Write("hole.yaml", R"(
no_step:
  - {name: clockwise, polygon_m: [[0, 0], [0, 1], [2, 1], [2, 0]]}
  - {name: counter-clockwise, polygon_m: [[0, 0], [2, 0], [2, 1], [0, 1]]}
)"));
  ASSERT_EQ(scene.no_step.size(), 2u);
  EXPECT_DOUBLE_EQ(SignedArea(scene.no_step[0]), 2.0);
  EXPECT_DOUBLE_EQ(SignedArea(scene.no_step[1]), 2.0);
  EXPECT_TRUE(scene.obstacles.empty());
}

TEST_F(SceneTest, ComplainsAboutAFileThatIsNotThere) {
  EXPECT_THROW(LoadScene("no_such_scene.yaml"), InputError);
}

TEST(SimplePolygon, SeesWhereEdgesTouch) {
  Eigen::Matrix2Xd square(2, 4);
  square << 0, 1, 1, 0, 0, 0, 1, 1;
  EXPECT_EQ(WhyNotSimple(square), "");
  EXPECT_EQ(WhyNotSimple(square.leftCols(2)), "fewer than three vertices");

  Eigen::Matrix2Xd straight_corner(2, 5);  // a vertex in the middle of an edge is allowed
  straight_corner << 0, 0.5, 1, 1, 0, 0, 0, 0, 1, 1;
  EXPECT_EQ(WhyNotSimple(straight_corner), "");

  Eigen::Matrix2Xd pinched(2, 5);  // vertex 3 lies on edge 0–1
  pinched << 0, 2, 2, 1, 0, 0, 0, 1, 0, 1;
  EXPECT_EQ(WhyNotSimple(pinched), "edges 0–1 and 2–3 meet");
}

class SceneFixture : public testing::TestWithParam<std::string> {};

TEST_P(SceneFixture, IsRefused) {
  CheckFixture(GetParam(), [](const std::string& path) { (void)LoadScene(path); });
}

INSTANTIATE_TEST_SUITE_P(Bad, SceneFixture, testing::ValuesIn(Fixtures("scene")), FixtureName);

}  // namespace
}  // namespace halfstep
