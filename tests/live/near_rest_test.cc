#include "experiments/live/near_rest.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "experiments/run/planning.h"
#include "tests/live/small_episode.h"

namespace halfstep {
namespace {

// A block beside the standing robot. Its error is such that the robot's margin is `margin` [m].
Obstacle BlockBeside(double y, double margin) {
  const SmallWorld& world = SmallWorld::Get();
  Obstacle block{.name = y > 0.0 ? "left" : "right", .shape = Box{{0.4, 0.2, 1.0}}};
  block.X_WO.translation() = Eigen::Vector3d(0.0, y, 0.5);
  const CollisionWorld alone([&] {
    Scene scene = world.place.scene.Emptied();
    scene.obstacles = {block};
    return scene;
  }());
  const Footstep in_place{.side = Side::kRight, .X_WF = world.start[1]};
  const HalfStep like = PrototypeOf(world.config.experiment);
  WalkPlan plan;
  plan.sequence = MakeSequence(world.start, {in_place}, like.via_lateral, like.shape,
                               MotionModelOf(world.place.robot, like.shape));
  plan.parameters = PlannedMotion(plan.sequence);
  const Posture posture = SolvePosture(world.place.robot, plan.Walk().At(0.0).value);
  double distance = 1.0;
  for (const RobotBody& body : world.place.robot.bodies) {
    distance = std::min(
        distance,
        alone.FindNearest(CollisionShape(body.shape), posture.OfBody(body), 0.0, 1.0).margin);
  }
  block.motion.error = distance - margin;
  return block;
}

TEST(NearRest, KeepsLessFromEachOfTwoObstaclesThatAreTooNear) {
  const SmallWorld& world = SmallWorld::Get();
  const ExperimentConfig& config = world.config.experiment;
  Scene scene = world.place.scene.Emptied();
  scene.obstacles = {BlockBeside(0.6, 0.003), BlockBeside(-0.6, 0.002)};
  const SafetyCheck among(world.place.robot, scene, config);
  const auto near = NearRest::AtStart(among, config, world.start, PrototypeOf(config));
  ASSERT_TRUE(near);
  EXPECT_EQ(near->half_step(), 0);
  EXPECT_NEAR(near->margin(), 0.002, 1e-6);
  const MarginEvaluator& evaluator = near->safety().evaluator();
  EXPECT_EQ(evaluator.robot().name, world.place.robot.name);
  EXPECT_EQ(evaluator.robot().bodies.size(), world.place.robot.bodies.size());
  // Of each what it has when the half-step begins, less 1 mm, is as much as is demanded.
  for (const size_t i : {0u, 1u}) {
    const double less =
        scene.obstacles[i].motion.error - evaluator.scene().obstacles[i].motion.error;
    EXPECT_NEAR(less, 0.005 - (i == 0 ? 0.002 : 0.001), 1e-6);
  }
}

TEST(NearRest, IsForObstaclesThatAreTooNearAndSurelyNotTouched) {
  const SmallWorld& world = SmallWorld::Get();
  const ExperimentConfig& config = world.config.experiment;
  for (const double margin : {0.006, -0.001}) {
    Scene scene = world.place.scene.Emptied();
    scene.obstacles = {BlockBeside(0.6, 0.003), BlockBeside(-0.6, margin)};
    const SafetyCheck among(world.place.robot, scene, config);
    EXPECT_EQ(NearRest::AtStart(among, config, world.start, PrototypeOf(config)).has_value(),
              margin > 0.0);
  }
}

}  // namespace
}  // namespace halfstep
