#include "planner/swept/swept_volume_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "planner/collision/collision_world.h"
#include "planner/collision/mesh_interior.h"
#include "planner/collision/mesh_winding.h"
#include "tests/planner/swept_volume_draws.h"
#include "wpg/files/input_error.h"
#include "wpg/geometry/support_polygon.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

const Eigen::Vector2d kSoleSize(0.22, 0.14);
const Eigen::Matrix2Xd kSole = SoleCorners({}, kSoleSize);

Scene One(Shape shape, const Isometry3d& X_WO) {
  Scene scene;
  scene.obstacles.push_back({"o", std::move(shape), X_WO});
  return scene;
}

struct Asked {
  int element;
  Side support;
  Foothold X_WS;
};
Asked DrawQuery(double reach, SweptDraw* draw) {
  const int element = draw->Index(CoarseVolumes().set.size());
  const Side support = draw->AnySide();
  return {element, support, Foothold::Level(draw->Floor(reach))};
}

// Boxes, balls, capsules and cylinders.
Scene Mixed(int count, SweptDraw* draw) {
  Scene scene = DrawBoxes(count, 1.5, false, draw);
  for (int i = 0; i < count; ++i) {
    Obstacle& o = scene.obstacles[static_cast<size_t>(i)];
    const double radius = draw->Uniform(0.01, 0.15), length = draw->Uniform(0.05, 0.5);
    if (i % 4 == 1) o.shape = Sphere{radius};
    if (i % 4 == 2) o.shape = Capsule{radius, length};
    if (i % 4 == 3) o.shape = Cylinder{radius, length};
  }
  return scene;
}

std::vector<CollisionShape> ShapesOf(const RobotModel& robot) {
  std::vector<CollisionShape> shapes;
  for (const RobotBody& body : robot.bodies) shapes.emplace_back(body.shape);
  return shapes;
}

// The robot is posed at many instants of what was called free: no body is nearer than δ.
TEST(SweptVolumeQueryTest, FreeHalfStepsKeepTheClearanceOnBothSidesUpAndDown) {
  const RobotModel& robot = SweptRobot();
  const SweptVolumes& volumes = CoarseVolumes();
  SweptDraw draw(1);
  const std::vector<CollisionShape> shapes = ShapesOf(robot);
  int free = 0, taken = 0;
  for (int room = 0; room < 2; ++room) {
    const Scene scene = Mixed(12, &draw);
    const CollisionWorld world(scene);
    const SweptVolumeQuery query(volumes, kSole, scene);
    for (int k = 0; k < 24; ++k) {
      const auto [i, support, X_WS] = DrawQuery(1.5, &draw);
      const bool down = k % 2 == 0;
      if (!(down ? query.DownIsFree(i, support, X_WS) : query.UpIsFree(i, support, X_WS))) {
        ++taken;
        continue;
      }
      ++free;
      const HalfStep half_step = down ? volumes.set.Down(i, support) : volumes.set.Up(i, support);
      const Foothold X_WFoot = down ? X_WS : X_WS * volumes.set.Placement(i, support);
      const HalfStepTracks tracks(half_step, LipmOf(robot));
      for (int n = 0; n <= 4; ++n) {
        const double tau = half_step.duration * n / 4;
        const WalkState x_W = Transformed(X_WFoot, tracks.At(tau).value);
        const Posture posture = SolvePosture(robot, x_W);
        for (size_t b = 0; b < robot.bodies.size(); ++b) {
          CollisionWorld::Scratch scratch;
          EXPECT_TRUE(world.Clears(shapes[b], posture.OfBody(robot.bodies[b]), 0.0,
                                   CoarseOptions().clearance, &scratch))
              << "room " << room << ", query " << k << ", body " << robot.bodies[b].name;
        }
      }
    }
  }
  EXPECT_GT(free, 5);
  EXPECT_GT(taken, 5);
}

// Whenever it is executed, wherever uncertainty lets the obstacles be.
TEST(SweptVolumeQueryTest, WhatIsFreeAmongObstaclesThatMoveIsFreeAtAnyTime) {
  const RobotModel& robot = SweptRobot();
  const SweptVolumes& volumes = CoarseVolumes();
  SweptDraw draw(20);
  const std::vector<CollisionShape> shapes = ShapesOf(robot);
  int free = 0, of_rest_only = 0, hit = 0;
  for (int room = 0; room < 6; ++room) {
    Scene scene = Mixed(5, &draw), resting = scene;
    for (size_t i = 0; i < scene.obstacles.size(); ++i) {
      ObstacleMotion& motion = scene.obstacles[i].motion;
      motion.error = draw.Uniform(0, 0.02);
      if (i % 2 == 0) {
        motion.speed = draw.Uniform(0, 0.1);
        motion.horizon = 1.0;
        continue;
      }
      for (const double t : {1.0, 2.5}) {
        motion.waypoints.push_back({t, draw.Point({-1, -1, 0}, {1, 1, 0.5}), draw.Uniform(-2, 2)});
      }
    }
    const CollisionWorld world(scene);
    const SweptVolumeQuery query(volumes, kSole, scene), at_rest(volumes, kSole, resting);
    for (int k = 0; k < 40; ++k) {
      const auto [i, support, X_WS] = DrawQuery(1.5, &draw);
      const bool is_free = query.DownIsFree(i, support, X_WS);
      if (!is_free && !at_rest.DownIsFree(i, support, X_WS)) continue;
      const HalfStep half_step = volumes.set.Down(i, support);
      const HalfStepTracks tracks(half_step, LipmOf(robot));
      bool clears = true;
      for (int n = 0; n <= 3; ++n) {
        const double tau = half_step.duration * n / 3;
        const WalkState x_W = Transformed(X_WS, tracks.At(tau).value);
        const Posture posture = SolvePosture(robot, x_W);
        for (size_t b = 0; b < robot.bodies.size(); ++b) {
          for (double t = 0.0; t < 3.0; t += 0.25) {
            CollisionWorld::Scratch scratch;
            clears = clears && world.Clears(shapes[b], posture.OfBody(robot.bodies[b]), t,
                                            CoarseOptions().clearance, &scratch);
          }
        }
      }
      EXPECT_TRUE(clears || !is_free) << "room " << room << ", query " << k;
      free += is_free;
      of_rest_only += !is_free;
      hit += !clears;
    }
  }
  EXPECT_GT(free, 20);
  EXPECT_GT(of_rest_only, 5);
  EXPECT_GT(hit, 5);  // the control: what the scene at rest calls free
}

TEST(SweptVolumeQueryTest, PlacesContainTheObstacleAtEveryTime) {
  SweptDraw draw(21);
  double used = 0.0;  // of what places are grown by
  for (int i = 0; i < 20; ++i) {
    Obstacle obstacle{.name = "o", .shape = Box{{0.4, 0.1, 0.1}}};
    obstacle.X_WO.translation() = draw.Point({-1, -1, 0}, {1, 1, 0.5});
    obstacle.motion.waypoints = {{1.0, draw.Point({-1, -1, 0}, {1, 1, 0.5}), draw.Uniform(-2, 2)},
                                 {3.0, draw.Point({-1, -1, 0}, {1, 1, 0.5}), draw.Uniform(-2, 2)}};
    const double until = i % 2 == 0 ? 1.7 : std::numeric_limits<double>::infinity();
    const std::vector<ObstaclePlace> places = PlacesOf(obstacle, until);
    for (int k = 0; k < 200; ++k) {
      const Isometry3d X = obstacle.PoseAt(std::min(until, draw.Uniform(-0.5, 4.0)));
      // Of all corners at once, as one place must hold the whole shape.
      double over = 1.0;
      for (const ObstaclePlace& place : places) {
        double farthest = 0.0;
        for (const double x : {-0.2, 0.2}) {
          const Vector3d p(x, 0.05, 0.05);
          farthest = std::max(farthest, (X * p - place.X_WO * p).norm());
        }
        over = std::min(over, farthest - place.extra);
        if (farthest <= place.extra) used = std::max(used, farthest / place.extra);
      }
      EXPECT_LE(over, 1e-12);
    }
  }
  EXPECT_GT(used, 0.8);
}

TEST(SweptVolumeQueryTest, AnObstacleThatMayBeAnywhereIsRefusedByName) {
  Scene scene = One(Sphere{0.1}, Isometry3d(Eigen::Translation3d(5, 0, 0)));
  scene.obstacles[0].motion.speed = 0.1;
  try {
    const SweptVolumeQuery query(CoarseVolumes(), kSole, scene);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("obstacle 'o': motion.horizon_s: is missing"), 0u)
        << error.what();
  }
  // For 10 s it is at most a metre away, for 60 s it may be here.
  EXPECT_TRUE(
      SweptVolumeQuery(CoarseVolumes(), kSole, scene, 0.0, 10.0).DownIsFree(0, Side::kLeft, {}));
  EXPECT_FALSE(
      SweptVolumeQuery(CoarseVolumes(), kSole, scene, 0.0, 60.0).DownIsFree(0, Side::kLeft, {}));
  scene.obstacles[0].motion = {.waypoints = {{1.0, {6, 0, 0}}}};
  SweptVolumeQuery query(CoarseVolumes(), kSole, scene);
  EXPECT_THROW(query.SetObstaclePose(0, Isometry3d::Identity()), std::logic_error);
}

TEST(SweptVolumeQueryTest, MirroredAndMovedScenesGiveTheSameAnswers) {
  SweptDraw draw(2);
  const Scene scene = DrawBoxes(20, 1.5, false, &draw);
  const Foothold X_VW(draw.Floor(2), 0.4);
  Scene mirrored = scene, moved = scene;
  const Eigen::Vector3d flip(1, -1, 1);
  for (size_t i = 0; i < scene.obstacles.size(); ++i) {
    // A box reflected by M is a box at M·R·M.
    Isometry3d& X = mirrored.obstacles[i].X_WO;
    X.linear() = flip.asDiagonal() * X.linear() * flip.asDiagonal();
    X.translation() = flip.cwiseProduct(X.translation());
    moved.obstacles[i].X_WO = ToIsometry(X_VW) * scene.obstacles[i].X_WO;
  }
  moved.ground = std::make_shared<const FlatGround>(X_VW.height);
  const SweptVolumes& volumes = CoarseVolumes();
  const SweptVolumeQuery query(volumes, kSole, scene), in_mirror(volumes, kSole, mirrored),
      elsewhere(volumes, kSole, moved);
  int free = 0;
  for (int k = 0; k < 300; ++k) {
    const auto [i, support, X_WS] = DrawQuery(1.5, &draw);
    const bool down = query.DownIsFree(i, support, X_WS), up = query.UpIsFree(i, support, X_WS);
    EXPECT_EQ(in_mirror.DownIsFree(i, Opposite(support), X_WS.Mirrored()), down);
    EXPECT_EQ(in_mirror.UpIsFree(i, Opposite(support), X_WS.Mirrored()), up);
    EXPECT_EQ(elsewhere.DownIsFree(i, support, X_VW * X_WS), down);
    EXPECT_EQ(elsewhere.UpIsFree(i, support, X_VW * X_WS), up);
    const Foothold above({X_WS.x, X_WS.y, X_WS.yaw}, 0.01);
    EXPECT_FALSE(query.DownIsFree(i, support, above) || query.UpIsFree(i, support, above));
    free += down + up;
  }
  EXPECT_GT(free, 50);
  EXPECT_LT(free, 550);
}

TEST(SweptVolumeQueryTest, AMovedObstacleAnswersLikeANewScene) {
  SweptDraw draw(3);
  Scene scene = Mixed(12, &draw);
  const SweptVolumes& volumes = CoarseVolumes();
  SweptVolumeQuery query(volumes, kSole, scene);
  int changed = 0;
  for (int move = 0; move < 12; ++move) {
    Isometry3d X_WO = Isometry3d::Identity();
    X_WO.linear() = draw.Turn(false);
    X_WO.translation() = draw.Point({-1, -1, 0}, {1, 1, 0.5});
    const SweptVolumeQuery before = query;
    query.SetObstaclePose(move, X_WO);
    scene.obstacles[static_cast<size_t>(move)].X_WO = X_WO;
    const SweptVolumeQuery fresh(volumes, kSole, scene);
    for (int k = 0; k < 60; ++k) {
      const auto [i, support, X_WS] = DrawQuery(1.2, &draw);
      EXPECT_EQ(query.DownIsFree(i, support, X_WS), fresh.DownIsFree(i, support, X_WS));
      changed += query.DownIsFree(i, support, X_WS) != before.DownIsFree(i, support, X_WS);
    }
  }
  EXPECT_GT(changed, 5);
}

TEST(SweptVolumeQueryTest, ABoxAsAMeshAndAsAHullAnswersLikeTheBox) {
  SweptDraw draw(4);
  const SweptVolumes& volumes = CoarseVolumes();
  for (int trial = 0; trial < 100; ++trial) {
    const ConvexBody box = MakeBox(draw.Point({0.05, 0.05, 0.05}, {1, 1, 1}));
    Isometry3d X_WO = Isometry3d::Identity();
    X_WO.linear() = draw.Turn(trial % 2 == 0);
    X_WO.translation() = draw.Point({-1, -1, 0}, {1, 1, 0.5});
    ConvexBody hull = box;
    hull.vertices = 1.0000001 * box.vertices;
    hull.vertices.col(0) *= 1.0000001;  // no box any more
    const auto [i, support, X_WS] = DrawQuery(0.3, &draw);
    const bool free = SweptVolumeQuery(volumes, kSole, One(box, X_WO)).DownIsFree(i, support, X_WS);
    EXPECT_EQ(
        SweptVolumeQuery(volumes, kSole, One(FacesOf(box), X_WO)).DownIsFree(i, support, X_WS),
        free);
    EXPECT_EQ(SweptVolumeQuery(volumes, kSole, One(hull, X_WO)).DownIsFree(i, support, X_WS), free);
  }
}

// As a box that is larger by the ball, but for the ball's corners and what queries grow by.
TEST(SweptVolumeQueryTest, AHullWithABallIsMetWhereTheHullGrownByItIs) {
  SweptDraw draw(5);
  const SweptVolumes& volumes = CoarseVolumes();
  int met = 0, freed = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Vector3d size = draw.Point({0.05, 0.05, 0.05}, {0.5, 0.5, 0.5});
    const Vector3d p_W = draw.Point({-1, -1, 0}, {1, 1, 0.5});
    const double ball = 0.1;
    const auto is_free = [&](const ConvexBody& body) {
      return SweptVolumeQuery(volumes, kSole, One(body, Isometry3d(Eigen::Translation3d(p_W))))
          .DownIsFree(0, Side::kLeft, {});
    };
    ConvexBody rounded = MakeBox(size);
    rounded.ball_radius = ball;
    BoundBySphere(&rounded);
    const bool free = is_free(rounded);
    EXPECT_LE(free, is_free(MakeBox(size))) << "the box without its ball";
    for (int axis = 0; axis < 3; ++axis) {  // boxes inside the rounded one
      Vector3d longer = size;
      longer[axis] += 2 * ball;
      EXPECT_LE(free, is_free(MakeBox(longer)));
    }
    met += !free;
    freed += free && !is_free(MakeBox(size + Vector3d::Constant(4 * ball)));
  }
  EXPECT_GT(met, 20);
  EXPECT_GT(freed, 5) << "it is not taken as something much larger";
}

TEST(SweptVolumeQueryTest, SmallObstaclesInsideAndHollowOnesAroundAreMet) {
  const SweptVolumes& volumes = CoarseVolumes();
  const auto is_free = [&](Shape shape, const Vector3d& p_W) {
    return SweptVolumeQuery(volumes, kSole, One(shape, Isometry3d(Eigen::Translation3d(p_W))))
        .DownIsFree(0, Side::kLeft, {});
  };
  for (const auto& box : volumes.down[0]->SolidBoxes()) {
    if ((box.upper - box.lower).minCoeff() < 2) continue;
    const Vector3d middle =
        0.5 * (volumes.down[0]->Corner(box.lower) + volumes.down[0]->Corner(box.upper));
    EXPECT_FALSE(is_free(MakeBox({1e-3, 1e-3, 1e-3}), middle));
    EXPECT_FALSE(is_free(FacesOf(MakeBox({1e-3, 1e-3, 1e-3})), middle));
    EXPECT_FALSE(is_free(MakeSphere(1e-3), middle));
  }
  EXPECT_FALSE(is_free(MakeBox({10, 10, 10}), {0, 0, 0}));
  EXPECT_FALSE(is_free(MakeSphere(10), {0, 0, 0}));
  EXPECT_FALSE(is_free(FacesOf(MakeBox({10, 10, 10})), {0, 0, 0}));
  EXPECT_TRUE(is_free(FacesOf(MakeBox({10, 10, 10})), {0, 0, -10}));
  EXPECT_TRUE(is_free(FacesOf(MakeBox({10, 10, 10})), {11, 0, 0}));
}

// Blocks of a kilometre, 10 µm into what the robot sweeps: floats round their middles by more.
TEST(SweptVolumeQueryTest, HugeObstaclesAreMetThoughTheirPlacesAreRounded) {
  SweptDraw draw(19);
  const double lowest = CoarseVolumes().down[0]->Lower().z();
  for (int i = 0; i < 40; ++i) {
    const double height = draw.Uniform(500, 20000);
    Isometry3d X_WO = Isometry3d::Identity();
    X_WO.translation().z() = lowest + 1e-5 - 0.5 * height;
    const SweptVolumeQuery query(CoarseVolumes(), kSole, One(MakeBox({3, 3, height}), X_WO));
    EXPECT_FALSE(query.DownIsFree(0, Side::kLeft, {})) << height;
  }
}

TEST(SweptVolumeQueryTest, ClearanceIsFreeAndKnownToTheMillimetre) {
  SweptDraw draw(5);
  const SweptVolumes& volumes = CoarseVolumes();
  const double face = volumes.down[0]->Upper().x();
  // A wall 0.2 m ahead of the volume.
  Isometry3d X_WO(Eigen::Translation3d(face + 0.2 + 0.05, 0, 1));
  const SweptVolumeQuery query(volumes, kSole, One(MakeBox({0.1, 4, 4}), X_WO));
  EXPECT_NEAR(query.DownClearance(0, Side::kLeft, {}, 1.0), 0.2, 2e-3);
  EXPECT_LE(query.DownClearance(0, Side::kLeft, {}, 1.0), 0.2);
  EXPECT_EQ(query.DownClearance(0, Side::kLeft, {}, 0.1), 0.1);
  EXPECT_EQ(query.DownClearance(0, Side::kLeft, Foothold::Level({0.3, 0, 0}), 0.1), 0.0);
  // Of a wall that is known within 5 cm, 15 cm are left.
  Scene known = One(MakeBox({0.1, 4, 4}), X_WO);
  known.obstacles[0].motion.error = 0.05;
  const SweptVolumeQuery within(volumes, kSole, known);
  EXPECT_NEAR(within.DownClearance(0, Side::kLeft, {}, 1.0), 0.15, 2e-3);
}

TEST(SweptVolumeQueryTest, OnlyTheLandingSoleKeepsOffNoStepAreas) {
  const SweptVolumes& volumes = CoarseVolumes();
  Scene scene;
  Eigen::Matrix2Xd area(2, 4);
  area << -0.02, 0.02, 0.02, -0.02, -0.02, -0.02, 0.02, 0.02;
  scene.no_step.push_back(area);
  const SweptVolumeQuery query(volumes, kSole, scene);
  for (const Side support : {Side::kLeft, Side::kRight}) {
    const Foothold X_SF = volumes.set.Placement(0, support);
    EXPECT_FALSE(query.DownIsFree(0, support, X_SF.Inverse()));
    EXPECT_TRUE(query.UpIsFree(0, support, X_SF.Inverse()));
    EXPECT_TRUE(query.DownIsFree(0, support, {}));
    const Foothold beside = Foothold::Level({0.5 * kSoleSize.x() + 0.03, 0, 0}) * X_SF.Inverse();
    EXPECT_TRUE(query.DownIsFree(0, support, beside));
    // 1 cm apart: not enough where 2 cm are demanded.
    EXPECT_TRUE(SweptVolumeQuery(volumes, kSole, scene, 0.009).DownIsFree(0, support, beside));
    EXPECT_FALSE(SweptVolumeQuery(volumes, kSole, scene, 0.02).DownIsFree(0, support, beside));
  }
}

TEST(SweptVolumeQueryTest, AnElementWithoutVolumeIsNeverFree) {
  SweptVolumes volumes = CoarseVolumes();
  volumes.down[1].reset();
  const SweptVolumeQuery query(volumes, kSole, Scene{});
  EXPECT_FALSE(query.DownIsFree(1, Side::kLeft, {}));
  EXPECT_TRUE(query.UpIsFree(1, Side::kLeft, {}));
}

TEST(SweptVolumeQueryTest, PosesThatAreNotFiniteAreRefused) {
  SweptVolumeQuery query(CoarseVolumes(), kSole, One(MakeSphere(1), Isometry3d::Identity()));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)query.DownIsFree(0, Side::kLeft, Foothold::Level({nan, 0, 0})),
               std::logic_error);
  Isometry3d X_WO = Isometry3d::Identity();
  X_WO.translation().x() = nan;
  EXPECT_THROW(query.SetObstaclePose(0, X_WO), std::logic_error);
}

TEST(MeshWindingTest, AgreesWithTheSumOverAllTriangles) {
  SweptDraw draw(6);
  // Two closed hulls and an open one.
  TriangleMesh mesh;
  for (int part = 0; part < 3; ++part) {
    Eigen::Matrix3Xd points(3, 60);
    for (int i = 0; i < 60; ++i) points.col(i) = draw.Direction() + Vector3d(part, 0.5 * part, 0);
    const TriangleMesh hull = FacesOf(MakeHull(points));
    const Eigen::Index keep = hull.triangles.cols() - (part == 2 ? 10 : 0);
    const Eigen::Index v = mesh.vertices.cols(), t = mesh.triangles.cols();
    mesh.vertices.conservativeResize(3, v + hull.vertices.cols());
    mesh.vertices.rightCols(hull.vertices.cols()) = hull.vertices;
    mesh.triangles.conservativeResize(3, t + keep);
    mesh.triangles.rightCols(keep) = hull.triangles.leftCols(keep).array() + static_cast<int>(v);
  }
  const TriangleTree tree(mesh);
  const MeshWinding winding(tree);
  for (int k = 0; k < 300; ++k) {
    const Vector3d p = draw.Point({-2, -2, -2}, {4, 3, 2});
    // One triangle at a time: a tree of its own has no caps.
    double sum = 0;
    for (const Eigen::Matrix3d& t : tree.triangles) {
      const TriangleTree one({.vertices = t, .triangles = Eigen::Vector3i(0, 1, 2)});
      sum += MeshWinding(one).At(one, p);
    }
    EXPECT_NEAR(winding.At(tree, p), sum, 1e-9);
  }
}

}  // namespace
}  // namespace halfstep
