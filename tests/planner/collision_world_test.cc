#include "planner/collision/collision_world.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "planner/scene/shape_extents.h"
#include "planner/scene/solid_body.h"
#include "tests/draws.h"
#include "tests/planner/blocks_ground.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d RandomPose(double reach, std::mt19937* random) {
  const double x = Uniform(random, -reach, reach), y = Uniform(random, -reach, reach);
  const double roll = Uniform(random, -1, 1), yaw = Uniform(random, -3, 3);
  return Eigen::Translation3d(x, y, Uniform(random, 0, 0.5)) *
         Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) * Eigen::AngleAxisd(roll, Vector3d::UnitX());
}

TriangleMesh MeshOfBox(const Vector3d& size) {
  const ConvexBody box = MakeBox(size);
  TriangleMesh mesh{box.vertices, Eigen::Matrix3Xi(3, 12)};
  for (int i = 0; i < 12; ++i) mesh.triangles.col(i) = box.triangles[static_cast<size_t>(i)];
  return mesh;
}

// A room of 2 × 2 m with boxes, cylinders, capsules, spheres and meshes in turn.
Scene RandomRoom(int count, std::mt19937* random) {
  Scene scene;
  for (int i = 0; i < count; ++i) {
    Obstacle obstacle;
    obstacle.name = "obstacle " + std::to_string(i);
    const double r = Uniform(random, 0.01, 0.1), l = Uniform(random, 0.05, 0.4);
    if (i % 5 == 0) obstacle.shape = Box{{r, l, 0.1}};
    if (i % 5 == 1) obstacle.shape = Cylinder{r, l};
    if (i % 5 == 2) obstacle.shape = Capsule{r, l};
    if (i % 5 == 3) obstacle.shape = Sphere{r};
    if (i % 5 == 4) obstacle.shape = MeshOfBox({l, r, 0.2});
    obstacle.X_WO = RandomPose(1, random);
    scene.obstacles.push_back(obstacle);
  }
  return scene;
}

// Found without making the body of a shape, they are its body's, to the bit.
TEST(ShapeBounds, AreThoseOfTheBody) {
  std::mt19937 random(20);
  for (const Obstacle& obstacle : RandomRoom(500, &random).obstacles) {
    const auto compare = [&](const auto& shape) {
      const ConvexBody body = BodyOf(shape);
      const Eigen::AlignedBox3d bounds = BoundsOf(obstacle.shape, obstacle.X_WO);
      const Eigen::AlignedBox3d of_body = BoundsOf(body, obstacle.X_WO);
      EXPECT_EQ(bounds.min(), of_body.min()) << obstacle.name;
      EXPECT_EQ(bounds.max(), of_body.max()) << obstacle.name;
      const Vector3d half = HalfExtents(shape);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(half[axis], Support(body, Vector3d::Unit(axis))) << obstacle.name;
      }
    };
    if (const auto* box = std::get_if<Box>(&obstacle.shape)) compare(*box);
    if (const auto* cylinder = std::get_if<Cylinder>(&obstacle.shape)) compare(*cylinder);
    if (const auto* capsule = std::get_if<Capsule>(&obstacle.shape)) compare(*capsule);
    if (const auto* sphere = std::get_if<Sphere>(&obstacle.shape)) compare(*sphere);
  }
  EXPECT_THROW(HalfExtents(Box{{0.1, 0.0, 0.1}}), std::logic_error);
  EXPECT_THROW(HalfExtents(Cylinder{0.1, -1.0}), std::logic_error);
  EXPECT_THROW(HalfExtents(Capsule{std::nan(""), 1.0}), std::logic_error);
  EXPECT_THROW(HalfExtents(Sphere{0.0}), std::logic_error);
}

TEST(CollisionWorld, NearestIsTheSmallestSeparationOfAll) {
  std::mt19937 random(21);
  int found = 0;
  for (int i = 0; i < 30; ++i) {
    const Scene scene = RandomRoom(20, &random);
    const CollisionWorld world(scene);
    std::vector<CollisionShape> shapes;
    for (const Obstacle& obstacle : scene.obstacles) {
      shapes.emplace_back(obstacle.shape);
    }
    const CollisionShape body(i % 2 ? MakeBox({0.2, 0.1, 0.3}) : MakeCapsule(0.05, 0.3));
    for (int k = 0; k < 10; ++k) {
      const Isometry3d X_WB = RandomPose(1, &random);
      double smallest = 0.3;
      for (size_t o = 0; o < shapes.size(); ++o) {
        smallest =
            std::min(smallest, Separate(body, X_WB, shapes[o], scene.obstacles[o].X_WO).distance);
      }
      const auto nearest = world.FindNearest(body, X_WB, 0.0, 0.3);
      EXPECT_EQ(nearest.separation.distance, smallest);
      EXPECT_EQ(nearest.obstacle < 0, smallest == 0.3);
      found += nearest.obstacle >= 0 ? 1 : 0;
    }
  }
  EXPECT_GT(found, 100);
}

TEST(CollisionWorld, ClearsEqualsTheVerdictOfFindNearestAlongAMotion) {
  std::mt19937 random(22);
  int verdicts[2] = {0, 0};
  for (int i = 0; i < 10; ++i) {
    const CollisionWorld world(RandomRoom(25, &random));
    const CollisionShape body(i % 2 ? MakeBox({0.2, 0.1, 0.3}) : MakeCylinder(0.05, 0.3));
    const Isometry3d from = RandomPose(1, &random), to = RandomPose(1, &random);
    CollisionWorld::Scratch scratch;
    for (int k = 0; k <= 60; ++k) {
      Isometry3d X_WB = from;
      X_WB.translation() += k / 60.0 * (to.translation() - from.translation());
      X_WB.rotate(Eigen::AngleAxisd(0.02 * k, Vector3d::UnitZ()));
      const double distance = world.FindNearest(body, X_WB, 0.0, 1).separation.distance;
      if (std::abs(distance - 0.01) < 1e-6) continue;
      const bool clears = world.Clears(body, X_WB, 0.0, 0.01, &scratch);
      EXPECT_EQ(clears, distance >= 0.01);
      ++verdicts[clears ? 1 : 0];
    }
    EXPECT_LE(scratch.normals_W.size(), 25u);
  }
  EXPECT_GT(verdicts[0], 50);
  EXPECT_GT(verdicts[1], 50);
}

TEST(CollisionWorld, AnotherObstacleNeverRaisesTheNearestDistance) {
  std::mt19937 random(23);
  const Scene all = RandomRoom(25, &random);
  const CollisionShape body(MakeBox({0.2, 0.1, 0.3}));
  for (int k = 0; k < 10; ++k) {
    const Isometry3d X_WB = RandomPose(1, &random);
    double before = 2;
    Scene scene;
    for (const Obstacle& obstacle : all.obstacles) {
      scene.obstacles.push_back(obstacle);
      const double distance =
          CollisionWorld(scene).FindNearest(body, X_WB, 0.0, 2).separation.distance;
      EXPECT_LE(distance, before + 1e-9);
      before = distance;
    }
  }
}

TEST(CollisionWorld, EmptyAndFarWorldsAreFree) {
  const CollisionShape body(MakeSphere(0.1));
  CollisionWorld::Scratch scratch;
  Scene scene;
  EXPECT_TRUE(CollisionWorld(scene).Clears(body, Isometry3d::Identity(), 0.0, 0.1, &scratch));
  EXPECT_EQ(CollisionWorld(scene).FindNearest(body, Isometry3d::Identity(), 0.0, 1).obstacle, -1);
  scene.obstacles.push_back({"far", Sphere{0.5}, Isometry3d(Eigen::Translation3d(3, 0, 0))});
  const CollisionWorld world(scene);
  const auto none = world.FindNearest(body, Isometry3d::Identity(), 0.0, 1);
  EXPECT_EQ(none.obstacle, -1);
  EXPECT_EQ(none.separation.distance, 1);
  const auto far = world.FindNearest(body, Isometry3d::Identity(), 0.0, 5);
  EXPECT_EQ(far.obstacle, 0);
  EXPECT_NEAR(far.separation.distance, 2.4, 1e-12);
  EXPECT_NEAR(far.separation.normal_W.x(), -1, 1e-12);
  EXPECT_NEAR(far.separation.point_b_W.x(), 2.5, 1e-9);
  EXPECT_TRUE(world.Clears(body, Isometry3d::Identity(), 0.0, 2.39, &scratch));
  EXPECT_FALSE(world.Clears(body, Isometry3d::Identity(), 0.0, 2.41, &scratch));
}

// A ball 1 m ahead.
Scene OneBall(const ObstacleMotion& motion) {
  Scene scene;
  scene.obstacles.push_back({.name = "ball", .shape = Sphere{0.05}, .motion = motion});
  scene.obstacles.back().X_WO = Isometry3d(Eigen::Translation3d(1, 0, 0));
  return scene;
}

// What an obstacle may do in half of the interval counts where it is looked for, too: measured just
// now, it may come 10 cm nearer in either half, from 5 cm away.
TEST(CollisionWorld, FindsAnObstacleThatComesNearOnlyWithinTheInterval) {
  const CollisionWorld world(OneBall({.speed = 2.0, .measured_at = 1.0}));
  const CollisionShape body(Sphere{0.1});
  const Isometry3d X_WB(Eigen::Translation3d(0.8, 0, 0));
  CollisionWorld::Scratch scratch;
  EXPECT_TRUE(world.Clears(body, X_WB, 1.0, 0.04, &scratch));
  EXPECT_FALSE(world.Clears(body, X_WB, 1.0, 0.0, &scratch, 0.05));
  EXPECT_TRUE(world.Clears(body, X_WB, 1.0, 0.0, &scratch, 0.02));
  EXPECT_EQ(world.FindNearest(body, X_WB, 1.0, 0.02).obstacle, -1);
  const CollisionWorld::Nearest nearest = world.FindNearest(body, X_WB, 1.0, 0.02, 0.05);
  EXPECT_EQ(nearest.obstacle, 0);
  EXPECT_NEAR(nearest.margin, 0.05, 1e-9);
}

// Beyond its bounds by its error alone, which the cull of far obstacles must count.
TEST(CollisionWorld, FindsAnObstacleThatIsNearByItsErrorAlone) {
  const CollisionWorld world(OneBall({.error = 0.3}));
  const CollisionShape body(Sphere{0.1});
  const Isometry3d X_WB(Eigen::Translation3d(0.6, 0, 0));
  CollisionWorld::Scratch scratch;
  EXPECT_FALSE(world.Clears(body, X_WB, 0.0, 0.0, &scratch));
  EXPECT_NEAR(world.FindNearest(body, X_WB, 0.0, 0.0).margin, -0.05, 1e-9);
}

// Solids of the ground come behind the obstacles; low ones may be left out, obstacles never.
TEST(CollisionWorld, SolidsAreObstaclesAtRestUnlessTheyAreTooLow) {
  Scene scene;
  scene.obstacles.push_back({.name = "ball", .shape = Sphere{0.05}});
  scene.obstacles.back().X_WO.translation() << -1.0, 0.0, 0.1;
  GroundSolid turned = Block("turned", 0.0, 0.4, -0.2, 0.2, 0.3, 0.0);
  const Pose2 X_WT{2.0, 0.0, 0.7};
  turned.polygon = (X_WT.rotation() * turned.polygon).colwise() + X_WT.position();
  scene.ground = std::make_shared<const BlocksGround>(
      BlocksGround::kNoFloor, std::vector{Block("low", 0.0, 1.0, -1.0, 1.0, 0.1), turned});
  EXPECT_EQ(scene.NameOf(0), "ball");
  EXPECT_EQ(scene.NameOf(1), "low");
  EXPECT_EQ(scene.NameOf(2), "turned");
  EXPECT_EQ(scene.ObstacleAt(2), nullptr);
  EXPECT_EQ(scene.ObstacleAt(0), &scene.obstacles[0]);
  const CollisionWorld world(scene);
  EXPECT_EQ(world.num_obstacles(), 3);
  EXPECT_TRUE(world.has_solids());
  EXPECT_EQ(world.speed(2), 0.0);
  const CollisionShape body(MakeSphere(0.02));
  CollisionWorld::Scratch scratch;
  const auto at = [](double x, double z) { return Isometry3d(Eigen::Translation3d(x, 0.0, z)); };
  // Above the low one.
  const auto over = world.FindNearest(body, at(0.5, 0.15), 0.0, 1.0);
  EXPECT_EQ(over.obstacle, 1);
  EXPECT_NEAR(over.margin, 0.03, 1e-12);
  EXPECT_FALSE(world.Clears(body, at(0.5, 0.15), 0.0, 0.031, &scratch));
  EXPECT_TRUE(world.Clears(body, at(0.5, 0.15), 0.0, 0.031, &scratch, 0.0, 0.1));
  EXPECT_FALSE(world.Clears(body, at(0.5, 0.15), 0.0, 0.031, &scratch, 0.0, 0.0999));
  EXPECT_EQ(world.FindNearest(body, at(0.5, 0.15), 0.0, 1.0, 0.0, 0.1).obstacle, -1);
  // Before the corner of the turned one.
  const auto before = world.FindNearest(body, at(1.8, 0.15), 0.0, 0.5, 0.0, 0.2);
  EXPECT_EQ(before.obstacle, 2);
  EXPECT_NEAR(before.separation.point_b_W.z(), 0.15, 0.16);
  // The ball counts whatever is left out.
  EXPECT_EQ(world.FindNearest(body, at(-0.9, 0.1), 0.0, 0.5, 0.0, 10.0).obstacle, 0);
  EXPECT_FALSE(world.Clears(body, at(-0.9, 0.1), 0.0, 0.04, &scratch, 0.0, 10.0));
  // Corners one way or the other do not change where a solid is.
  GroundSolid other = Block("other", 0.0, 1.0, -1.0, 1.0, 0.1);
  other.polygon << 1.0, 1.0, 0.0, 0.0, -1.0, 1.0, 1.0, -1.0;
  EXPECT_TRUE(std::holds_alternative<Box>(BodyOf(other).shape));
  EXPECT_TRUE(std::holds_alternative<Box>(BodyOf(turned).shape));
  GroundSolid oblique = turned;
  oblique.polygon.col(2).x() += 0.01;
  EXPECT_FALSE(std::holds_alternative<Box>(BodyOf(oblique).shape));
  for (const GroundSolid& solid : {other, turned, oblique}) {
    const Obstacle body = BodyOf(solid);
    const ConvexBody shape = std::holds_alternative<Box>(body.shape)
                                 ? BodyOf(std::get<Box>(body.shape))
                                 : std::get<ConvexBody>(body.shape);
    const Eigen::Matrix3Xd corners = body.X_WO * Eigen::Matrix3Xd(shape.vertices);
    for (const Eigen::Vector2d& p : solid.polygon.colwise()) {
      for (const double z : {solid.bottom, solid.top}) {
        EXPECT_LT((corners.colwise() - Vector3d(p.x(), p.y(), z)).colwise().norm().minCoeff(),
                  1e-12);
      }
    }
  }
  other.top = other.bottom;
  EXPECT_THROW(BodyOf(other), std::logic_error);
}

TEST(CollisionWorld, PosesThatAreNotFiniteThrow) {
  std::mt19937 random(24);
  Scene scene = RandomRoom(3, &random);
  const CollisionWorld world(scene);
  const CollisionShape body(MakeSphere(0.1));
  Isometry3d bad = Isometry3d::Identity();
  bad.linear()(1, 2) = std::numeric_limits<double>::quiet_NaN();
  CollisionWorld::Scratch scratch;
  EXPECT_THROW(world.Clears(body, bad, 0.0, 0.1, &scratch), std::logic_error);
  EXPECT_THROW(world.FindNearest(body, bad, 0.0, 1), std::logic_error);
  scene.obstacles[1].X_WO = bad;
  EXPECT_THROW(CollisionWorld{scene}, std::logic_error);
}

TEST(CollisionWorld, ThreadsShareOneWorldAndOneBody) {
  std::mt19937 random(25);
  const CollisionWorld world(RandomRoom(20, &random));
  const CollisionShape body(MakeCylinder(0.05, 0.3));
  std::vector<Isometry3d> poses;
  for (int i = 0; i < 50; ++i) poses.push_back(RandomPose(1, &random));
  std::vector<double> distances[2];
  {
    std::vector<std::jthread> threads;
    for (auto& mine : distances) {
      threads.emplace_back([&] {
        for (const Isometry3d& X_WB : poses) {
          mine.push_back(world.FindNearest(body, X_WB, 0.0, 1).separation.distance);
        }
      });
    }
  }
  EXPECT_EQ(distances[0], distances[1]);
}

}  // namespace
}  // namespace halfstep
