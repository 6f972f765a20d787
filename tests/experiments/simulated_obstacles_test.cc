#include "experiments/replay/simulated_obstacles.h"
#include "experiments/config/data_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/config/experiment.h"
#include "experiments/replay/mujoco_model.h"
#include "experiments/replay/simulation.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep::replay {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// A wedge: as a mesh, its own convex hull.
TriangleMesh Wedge(double height) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, 4);
  mesh.vertices << -0.1, 0.1, 0.0, 0.0, -0.1, -0.1, 0.1, 0.0, 0.0, 0.0, 0.0, height;
  mesh.triangles.resize(3, 4);
  mesh.triangles << 0, 0, 1, 2, 2, 1, 2, 0, 1, 3, 3, 3;
  return mesh;
}

Scene SceneOf(const Shape& shape, const Eigen::Vector3d& p_W) {
  Scene scene;
  scene.obstacles.push_back({.name = "thing", .shape = shape});
  scene.obstacles[0].X_WO.translation() = p_W;
  return scene;
}

ScriptEvent EventOf(const std::string& what, double at) {
  ScriptEvent event;
  event.at = at;
  event.what = what;
  event.obstacle = "thing";
  return event;
}

/// HRP-2, standing with the waist above the origin.
class SimulatedObstaclesTest : public testing::Test {
 protected:
  std::vector<Touch> TouchesAmong(const SimulatedObstacles& world) const {
    const auto& [robot, tree] = whole_;
    Simulation simulation(MujocoModel(robot, tree, {}, world.obstacles), robot, "WAIST",
                          world.obstacles);
    simulation.Place(X_WB(), {robot.legs[0].standing_q, robot.legs[1].standing_q});
    return simulation.touches();
  }
  Eigen::Isometry3d X_WB() const {
    return Eigen::Isometry3d(Eigen::Translation3d(0, 0, whole_.model.waist_height));
  }

  const WholeRobot whole_ = LoadWholeRobot((RobotsFolder() / "hrp2.yaml").string());
};

TEST_F(SimulatedObstaclesTest, EveryShapeIsTouchedWhereItIsAndNotElsewhere) {
  if (!WhyNoSimulation().empty()) GTEST_SKIP() << WhyNoSimulation();
  const std::vector<Shape> shapes = {Box{{0.2, 0.2, 0.2}}, Sphere{0.1}, Cylinder{0.1, 0.2},
                                     Capsule{0.1, 0.1}, Wedge(0.2)};
  const Eigen::Vector3d left_foot(0.0, 0.105, 0.08), beside(0.0, 1.0, 0.08);
  for (const Shape& shape : shapes) {
    const std::vector<Touch> touches = TouchesAmong(ObstaclesOf(SceneOf(shape, left_foot)));
    ASSERT_FALSE(touches.empty()) << shape.index();
    for (const Touch& touch : touches) {
      EXPECT_EQ(touch.obstacle, 0);
      EXPECT_EQ(whole_.model.bodies[static_cast<size_t>(touch.body)].leg, 0) << shape.index();
    }
    EXPECT_THAT(TouchesAmong(ObstaclesOf(SceneOf(shape, beside))), IsEmpty()) << shape.index();
  }
}

TEST_F(SimulatedObstaclesTest, TellsWhatItTakesOtherwise) {
  const SimulatedObstacles hull = ObstaclesOf(SceneOf(Wedge(0.2), {0, 0, 0}));
  EXPECT_EQ(hull.obstacles.size(), 1u);
  EXPECT_THAT(hull.notes,
              ElementsAre("Obstacle 'thing' is simulated as the convex hull of its mesh."));
  const SimulatedObstacles flat = ObstaclesOf(SceneOf(Wedge(0.0), {0, 0, 0}));
  EXPECT_THAT(flat.obstacles, IsEmpty());
  EXPECT_THAT(flat.notes, ElementsAre("Obstacle 'thing' is not simulated: its mesh is flat."));
  EXPECT_THAT(ObstaclesOf(SceneOf(Sphere{0.1}, {0, 0, 0})).notes, IsEmpty());
}

// A box that is there for a second and is carried meanwhile.
TEST_F(SimulatedObstaclesTest, AreWhereTheyTrulyAre) {
  LiveOptions options;
  options.script = {EventOf("appear", 1.0), EventOf("carry", 1.0), EventOf("vanish", 2.0)};
  options.script[1].xyz = {3.0, 0.0, 0.0};
  options.script[1].speed = 0.5;
  const TrueWorld truth(SceneOf(Box{{0.2, 0.2, 0.2}}, {1, 0, 0}), {}, options);
  const SimulatedObstacles world = ObstaclesOf(truth);
  ASSERT_EQ(world.obstacles.size(), 1u);
  const auto& pose = world.obstacles[0].pose;
  EXPECT_FALSE(pose(0.5).has_value());
  ASSERT_TRUE(pose(1.5).has_value());
  EXPECT_NEAR(pose(1.5)->translation().x(), 1.25, 1e-12);
  EXPECT_FALSE(pose(2.5).has_value());
}

}  // namespace
}  // namespace halfstep::replay
