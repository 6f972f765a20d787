#include "planner/scene/obstacle_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "planner/collision/collision_world.h"
#include "planner/scene/scene.h"
#include "tests/draws.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Vector3d DrawnPoint(std::mt19937* random, double reach) {
  const double x = Uniform(random, -reach, reach), y = Uniform(random, -reach, reach);
  return {x, y, Uniform(random, -reach, reach)};
}

Isometry3d DrawnPose(std::mt19937* random, double reach) {
  return Eigen::Translation3d(DrawnPoint(random, reach)) *
         Eigen::AngleAxisd(Uniform(random, -3, 3), DrawnPoint(random, 1).normalized());
}

ObstacleMotion DrawnMotion(std::mt19937* random) {
  ObstacleMotion motion;
  double t = 0.0;
  for (int i = 0; i < 4; ++i) {
    t += Uniform(random, 0.2, 1.5);
    motion.waypoints.push_back({t, DrawnPoint(random, 1), Uniform(random, -4, 4)});
  }
  motion.error = Uniform(random, 0, 0.02);
  motion.speed = Uniform(random, 0, 0.2);
  motion.measured_at = Uniform(random, -1, 2);
  if (random->operator()() % 2 == 0) motion.horizon = Uniform(random, 0, 3);
  return motion;
}

TEST(ObstacleMotion, GoesStraightFromWaypointToWaypointAndTurnsSteadily) {
  const Isometry3d X_WO = Eigen::Translation3d(0, 1, 0) * Eigen::AngleAxisd(0.3, Vector3d::UnitX());
  const ObstacleMotion motion{.waypoints = {{2.0, {1, 1, 0}, 0.0}, {4.0, {1, 3, 0}, 2.0}}};
  EXPECT_EQ(motion.PoseAt(X_WO, -1.0).matrix(), X_WO.matrix());
  EXPECT_EQ(motion.PoseAt(X_WO, 0.0).matrix(), X_WO.matrix());
  EXPECT_EQ(motion.PoseAt(X_WO, 1.0).translation(), Vector3d(0.5, 1, 0));
  EXPECT_EQ(motion.PoseAt(X_WO, 1.0).linear(), X_WO.linear());
  const Isometry3d at_3 = motion.PoseAt(X_WO, 3.0);
  EXPECT_TRUE(at_3.translation().isApprox(Vector3d(1, 2, 0), 1e-15));
  // About the world's z, after the turn about x.
  EXPECT_TRUE(
      at_3.linear().isApprox(Eigen::AngleAxisd(1.0, Vector3d::UnitZ()) * X_WO.linear(), 1e-15));
  EXPECT_EQ(motion.PoseAt(X_WO, 4.0).matrix(), motion.PoseAt(X_WO, 100.0).matrix());
  EXPECT_EQ(motion.PoseAt(X_WO, 4.0).translation(), Vector3d(1, 3, 0));
}

TEST(ObstacleMotion, UncertaintyGrowsOnBothSidesOfTheMeasurementUpToTheHorizon) {
  const ObstacleMotion motion{.error = 0.01, .speed = 0.2, .measured_at = 1.0, .horizon = 2.0};
  EXPECT_DOUBLE_EQ(motion.UncertaintyAt(1.0), 0.01);
  EXPECT_DOUBLE_EQ(motion.UncertaintyAt(0.0), 0.21);
  EXPECT_DOUBLE_EQ(motion.UncertaintyAt(2.5), 0.31);
  EXPECT_DOUBLE_EQ(motion.UncertaintyAt(50.0), 0.41);
  EXPECT_DOUBLE_EQ(motion.UncertaintyAt(-50.0), 0.41);
  EXPECT_DOUBLE_EQ((ObstacleMotion{.speed = 0.2}).UncertaintyAt(50.0), 10.0);
}

TEST(ObstacleMotion, RatesAreThoseOfDifferences) {
  constexpr double kStep = 1e-6;
  std::mt19937 random(31);
  for (int i = 0; i < 300; ++i) {
    const ObstacleMotion motion = DrawnMotion(&random);
    const Isometry3d X_WO = DrawnPose(&random, 1);
    const double t = Uniform(&random, -1, 7);
    const Vector3d p_O = DrawnPoint(&random, 0.5);
    const Vector3d velocity = motion.VelocityAt(X_WO, t, motion.PoseAt(X_WO, t) * p_O);
    // Towards later times, so a waypoint in between is a chance of 1e-6.
    const Vector3d moved = motion.PoseAt(X_WO, t + kStep) * p_O - motion.PoseAt(X_WO, t) * p_O;
    EXPECT_LT((moved / kStep - velocity).norm(), 1e-4 * (1 + velocity.norm()));
    EXPECT_NEAR((motion.UncertaintyAt(t + kStep) - motion.UncertaintyAt(t)) / kStep,
                motion.UncertaintyRateAt(t), 1e-6);
  }
}

TEST(ObstacleMotion, NoPointIsFasterOrFartherThanItsBounds) {
  std::mt19937 random(32);
  double fastest = 0.0, farthest = 0.0;  // as fractions of the bounds
  for (int i = 0; i < 300; ++i) {
    const ObstacleMotion motion = DrawnMotion(&random);
    const Isometry3d X_WO = DrawnPose(&random, 1);
    const Vector3d p_O = DrawnPoint(&random, 0.5);
    const double speed = motion.WaypointSpeed(X_WO, p_O.norm());
    for (int k = 0; k < 20; ++k) {
      const double a = Uniform(&random, -1, 7), b = Uniform(&random, -1, 7);
      const Vector3d p_a = motion.PoseAt(X_WO, a) * p_O, p_b = motion.PoseAt(X_WO, b) * p_O;
      const double way = speed * std::abs(b - a);
      EXPECT_LE((p_a - p_b).norm(), way + 1e-12);
      const double reach = motion.DisplacementAt(X_WO, p_O.norm(), a);
      EXPECT_LE((p_a - X_WO * p_O).norm(), reach + 1e-12);
      fastest = std::max(fastest, (p_a - p_b).norm() / (way + 1e-9));
      farthest = std::max(farthest, (p_a - X_WO * p_O).norm() / (reach + 1e-9));
    }
  }
  EXPECT_GT(fastest, 0.9);
  EXPECT_GT(farthest, 0.9);
}

// Boxes and capsules that move about a body.
Scene DrawnScene(std::mt19937* random) {
  Scene scene;
  for (int i = 0; i < 6; ++i) {
    Obstacle obstacle{.name = std::to_string(i), .shape = Box{{0.3, 0.1, 0.1}}};
    if (i % 2 == 1) obstacle.shape = Capsule{0.03, 0.4};
    obstacle.X_WO = DrawnPose(random, 1);
    if (i > 0) obstacle.motion = DrawnMotion(random);
    scene.obstacles.push_back(obstacle);
  }
  return scene;
}

TEST(ObstacleMotion, TheWorldsMarginIsTheDistanceThenLessTheUncertainty) {
  std::mt19937 random(33);
  const CollisionShape body(MakeBox({0.2, 0.1, 0.3}));
  int found = 0;
  for (int i = 0; i < 100; ++i) {
    const Scene scene = DrawnScene(&random);
    const CollisionWorld world(scene);
    const Isometry3d X_WB = DrawnPose(&random, 1);
    const double t = Uniform(&random, 0, 6);
    double least = 0.3;
    int of = -1;
    for (int o = 0; o < 6; ++o) {
      const Obstacle& obstacle = scene.obstacles[static_cast<size_t>(o)];
      const double margin =
          Separate(body, X_WB, CollisionShape(obstacle.shape), obstacle.PoseAt(t)).distance -
          obstacle.UncertaintyAt(t);
      if (margin < least) {
        least = margin;
        of = o;
      }
    }
    const auto nearest = world.FindNearest(body, X_WB, t, 0.3);
    EXPECT_EQ(nearest.margin, least);
    EXPECT_EQ(nearest.obstacle, of);
    CollisionWorld::Scratch scratch;
    for (const double clearance : {least - 1e-6, least + 1e-6, 0.05}) {
      if (of < 0 && clearance > 0.3) continue;
      EXPECT_EQ(world.Clears(body, X_WB, t, clearance, &scratch), least >= clearance);
    }
    found += of >= 0;
  }
  EXPECT_GT(found, 50);
}

TEST(ObstacleMotion, WhatClearsWithAHalfWidthClearsAtEveryTimeWithin) {
  std::mt19937 random(34);
  const CollisionShape body(MakeBox({0.2, 0.1, 0.3}));
  int cleared = 0, missed = 0;
  for (int i = 0; i < 400; ++i) {
    const CollisionWorld world(DrawnScene(&random));
    const Isometry3d X_WB = DrawnPose(&random, 1);
    const double t = Uniform(&random, 0, 6), h = Uniform(&random, 0, 0.1);
    CollisionWorld::Scratch scratch;
    const bool now = world.Clears(body, X_WB, t, 0.01, &scratch);
    const bool all = world.Clears(body, X_WB, t, 0.01, &scratch, h);
    EXPECT_TRUE(now || !all);
    bool truth = true;
    for (int k = -10; k <= 10; ++k) {
      truth = truth && world.Clears(body, X_WB, t + 0.1 * k * h, 0.01, &scratch);
    }
    EXPECT_TRUE(truth || !all);
    const auto worst = world.FindNearest(body, X_WB, t, 0.01, h);
    EXPECT_EQ(worst.obstacle < 0, all);
    cleared += all;
    missed += now && !truth;  // the control: what the instant alone would have missed
  }
  EXPECT_GT(cleared, 100);
  EXPECT_GT(missed, 5);
}

TEST(ObstacleMotion, AllLaterByTheSameTimeIsTheSameLater) {
  std::mt19937 random(36);
  const CollisionShape body(MakeBox({0.2, 0.1, 0.3}));
  for (int i = 0; i < 50; ++i) {
    const Scene scene = DrawnScene(&random);
    Scene later = scene;
    for (Obstacle& obstacle : later.obstacles) {
      for (ObstacleMotion::Waypoint& waypoint : obstacle.motion.waypoints) waypoint.t += 2.0;
      obstacle.motion.measured_at += 2.0;
      if (obstacle.motion.waypoints.empty()) continue;
      obstacle.motion.waypoints.insert(obstacle.motion.waypoints.begin(),
                                       {2.0, obstacle.X_WO.translation()});
    }
    const Isometry3d X_WB = DrawnPose(&random, 1);
    const double t = Uniform(&random, 0, 6);
    const auto a = CollisionWorld(scene).FindNearest(body, X_WB, t, 0.5);
    const auto b = CollisionWorld(later).FindNearest(body, X_WB, t + 2.0, 0.5);
    EXPECT_EQ(a.obstacle, b.obstacle);
    EXPECT_NEAR(a.margin, b.margin, 1e-9);
  }
}

TEST(ObstacleMotion, WithoutDisplacementIsRest) {
  std::mt19937 random(35);
  const CollisionShape body(MakeBox({0.2, 0.1, 0.3}));
  for (int i = 0; i < 30; ++i) {
    Scene still = DrawnScene(&random), moving;
    for (Obstacle& obstacle : still.obstacles) obstacle.motion = {};
    moving = still;
    for (Obstacle& obstacle : moving.obstacles) {
      obstacle.motion.waypoints = {{1.0, obstacle.X_WO.translation()},
                                   {3.0, obstacle.X_WO.translation()}};
    }
    const Isometry3d X_WB = DrawnPose(&random, 1);
    const auto a = CollisionWorld(still).FindNearest(body, X_WB, 2.0, 0.5);
    const auto b = CollisionWorld(moving).FindNearest(body, X_WB, 2.0, 0.5, 0.1);
    EXPECT_EQ(a.obstacle, b.obstacle);
    EXPECT_EQ(a.margin, b.margin);
    EXPECT_EQ(a.separation.normal_W, b.separation.normal_W);
  }
}

}  // namespace
}  // namespace halfstep
