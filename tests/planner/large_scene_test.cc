// Trees over obstacles and triangles: what they leave out is far away, and it costs nothing.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "planner/collision/collision_world.h"
#include "planner/collision/mesh_interior.h"
#include "planner/collision/triangle_surface.h"
#include "tests/planner/brute_force_distance.h"
#include "tests/planner/swept_volume_draws.h"
#include "wpg/geometry/bounds_tree.h"
#include "wpg/geometry/support_polygon.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// Boxes of 5 to 20 cm over a hall of 2·half × 2·half m; one in seven is uncertain, one in eleven
// goes somewhere.
Scene Hall(int count, double half, bool moving, SweptDraw* draw) {
  Scene scene;
  for (int i = 0; i < count; ++i) {
    Obstacle o{"o" + std::to_string(i), Box{draw->Point({0.05, 0.05, 0.05}, {0.2, 0.2, 0.2})}};
    o.X_WO.linear() = draw->Turn(i % 2 == 0);
    o.X_WO.translation() = draw->Point({-half, -half, 0}, {half, half, 0.4});
    if (moving && i % 7 == 0) o.motion.error = draw->Uniform(0, 0.3);
    if (moving && i % 14 == 0) {
      o.motion.speed = 0.1;
      o.motion.measured_at = draw->Uniform(-1, 3);
      o.motion.horizon = 2;
    }
    if (moving && i % 11 == 0) {
      o.motion.waypoints = {{2.0, draw->Point({-half, -half, 0}, {half, half, 0.4}), 1.0}};
    }
    scene.obstacles.push_back(std::move(o));
  }
  return scene;
}

// Balls of 80 triangles over a hall, as one mesh.
TriangleMesh Balls(int count, double half, SweptDraw* draw) {
  const TriangleMesh one = FacesOf(MakeHull([&] {
    Eigen::Matrix3Xd points(3, 42);
    for (auto p : points.colwise()) p = 0.08 * draw->Direction();
    return points;
  }()));
  TriangleMesh all;
  all.vertices.resize(3, count * one.vertices.cols());
  all.triangles.resize(3, count * one.triangles.cols());
  for (int i = 0; i < count; ++i) {
    const Vector3d at = draw->Point({-half, -half, 0}, {half, half, 0.4});
    all.vertices.middleCols(i * one.vertices.cols(), one.vertices.cols()) =
        one.vertices.colwise() + at;
    all.triangles.middleCols(i * one.triangles.cols(), one.triangles.cols()) =
        one.triangles.array() + static_cast<int>(i * one.vertices.cols());
  }
  return all;
}

TEST(BoundsTree, FindsAllThatIsNear) {
  SweptDraw draw(1);
  std::vector<Eigen::AlignedBox3d> boxes;
  for (int i = 0; i < 500; ++i) {
    const Vector3d p = draw.Point({-5, -5, -1}, {5, 5, 1});
    boxes.emplace_back(p, p + draw.Point({0, 0, 0}, {1, 1, 1}));
  }
  const BoundsTree tree(boxes, 3);
  for (int k = 0; k < 200; ++k) {
    const Vector3d p = draw.Point({-6, -6, -2}, {6, 6, 2});
    const double reach = draw.Uniform(0, 2);
    std::vector<int> visits(boxes.size(), 0);
    tree.ForEachNear(p, reach, [&](int i) { ++visits[static_cast<size_t>(i)]; });
    for (size_t i = 0; i < boxes.size(); ++i) {
      EXPECT_LE(visits[i], 1);
      if (boxes[i].exteriorDistance(p) <= reach) {
        EXPECT_EQ(visits[i], 1);
      }
    }
    EXPECT_LT(std::count(visits.begin(), visits.end(), 1), 400);
  }
}

TEST(TriangleSurface, InBlocksIsAsFarAsInOneAndBuildsOnlyWhatIsNear) {
  SweptDraw draw(2);
  const TriangleMesh mesh = Balls(400, 10, &draw);
  const TriangleSurface whole(mesh, TriangleSurface::kOneBlock), blocks(mesh, 64);
  const ConvexBody box = MakeBox({0.2, 0.1, 0.3});
  const TriangleSurface body(FacesOf(box), TriangleSurface::kOneBlock);
  Isometry3d X = Isometry3d::Identity();
  X.translation() = Vector3d(2, 2, 1);
  (void)TriangleSurface::Distance(body, X, X.translation(), box.radius, blocks,
                                  Isometry3d::Identity(), 1.0);
  EXPECT_GT(blocks.built(), 0);
  EXPECT_LT(blocks.built(), 40) << "of some 600";
  int found = 0;
  for (int k = 0; k < 60; ++k) {
    X.linear() = draw.Turn(false);
    X.translation() = draw.Point({-10, -10, 0}, {10, 10, 1});
    const double cap = draw.Uniform(0.05, 1);
    const auto a = TriangleSurface::Distance(body, X, X.translation(), box.radius, whole,
                                             Isometry3d::Identity(), 100);
    const auto b = TriangleSurface::Distance(body, X, X.translation(), box.radius, blocks,
                                             Isometry3d::Identity(), cap);
    ASSERT_TRUE(a);
    if (a->distance < cap) {
      ASSERT_TRUE(b) << a->distance;
      EXPECT_EQ(b->distance, a->distance) << "the same bits";
      ++found;
    } else {
      EXPECT_FALSE(b);
    }
  }
  EXPECT_GT(found, 10);
}

TEST(TriangleSurface, SlabsToTrianglesMeetTheDistanceFromAllOfThem) {
  SweptDraw draw(3);
  const TriangleMesh mesh = Balls(60, 1, &draw);
  const TriangleSurface surface(mesh);
  const std::vector<Eigen::Matrix3d> triangles = Triangles(mesh, Isometry3d::Identity());
  int apart = 0;
  for (int k = 0; k < 100; ++k) {
    ConvexBody box = MakeBox({0.2, 0.1, 0.3});
    box.ball_radius = k % 2 == 0 ? 0.0 : 0.03;
    BoundBySphere(&box);
    Isometry3d X = Isometry3d::Identity();
    X.linear() = draw.Turn(false);
    X.translation() = draw.Point({-1, -1, 0}, {1, 1, 1});
    const Vector3d first = k % 3 == 0 ? Vector3d::Zero() : draw.Direction();
    const double truth = SurfaceDistance(Triangles(box, X), triangles) - box.ball_radius;
    const double found = surface.LeastSlab(box, X, first, HUGE_VAL);
    EXPECT_LE(found, truth + 1e-12);
    if (found + box.ball_radius <= 0) continue;  // they meet
    ++apart;
    EXPECT_GE(found, truth - 1e-9);
    // What all are apart by is told, and no more than the truth of what they are not.
    EXPECT_EQ(surface.LeastSlab(box, X, first, truth - 1e-6), truth - 1e-6);
    const double more = surface.LeastSlab(box, X, first, truth + 1e-6);
    EXPECT_LE(more, truth + 1e-12);
    EXPECT_GE(more, truth - 1e-9);
  }
  EXPECT_GT(apart, 50);
}

TEST(CollisionWorld, AmongHundredsTheNearestIsTheSmallestOfAllAtEveryTime) {
  SweptDraw draw(3);
  const Scene scene = Hall(300, 3, true, &draw);
  const CollisionWorld world(scene);
  std::vector<CollisionShape> shapes;
  for (const Obstacle& o : scene.obstacles) shapes.emplace_back(o.shape);
  const CollisionShape body(MakeBox({0.2, 0.1, 0.3}));
  CollisionWorld::Scratch scratch;
  int found = 0, clear = 0;
  for (int k = 0; k < 80; ++k) {
    Isometry3d X = Isometry3d::Identity();
    X.linear() = draw.Turn(false);
    X.translation() = draw.Point({-3, -3, 0.5}, {3, 3, 1.5});
    const double t = draw.Uniform(0, 4), cap = draw.Uniform(0.05, 1);
    double least = cap;
    for (size_t i = 0; i < shapes.size(); ++i) {
      const Obstacle& o = scene.obstacles[i];
      least =
          std::min(least, Separate(body, X, shapes[i], o.PoseAt(t)).distance - o.UncertaintyAt(t));
    }
    const CollisionWorld::Nearest nearest = world.FindNearest(body, X, t, cap);
    EXPECT_EQ(nearest.margin, least);
    found += nearest.obstacle >= 0;
    const double demanded = 0.02;
    if (std::abs(least - demanded) < 1e-9) continue;
    EXPECT_EQ(world.Clears(body, X, t, demanded, &scratch), least >= demanded);
    clear += least >= demanded;
  }
  EXPECT_GT(found, 20);
  EXPECT_GT(clear, 10);
}

TEST(CollisionWorld, ARoomInOneMeshIsAsFarAsItsParts) {
  SweptDraw draw(4), again(4);
  const TriangleMesh mesh = Balls(60, 2, &draw);
  Scene one, parts;
  one.obstacles.push_back({"all", mesh});
  const Eigen::Index each = mesh.triangles.cols() / 60, corners = mesh.vertices.cols() / 60;
  for (int i = 0; i < 60; ++i) {
    parts.obstacles.push_back({"part" + std::to_string(i),
                               TriangleMesh{mesh.vertices.middleCols(i * corners, corners),
                                            mesh.triangles.middleCols(i * each, each).array() -
                                                static_cast<int>(i * corners)}});
  }
  const CollisionWorld whole(one), cut(parts);
  const CollisionShape body(MakeBox({0.2, 0.1, 0.3}));
  int near = 0;
  for (int k = 0; k < 60; ++k) {
    Isometry3d X = Isometry3d::Identity();
    X.linear() = draw.Turn(false);
    X.translation() = draw.Point({-2, -2, 0}, {2, 2, 1});
    const double a = whole.FindNearest(body, X, 0, 0.5).margin;
    const double b = cut.FindNearest(body, X, 0, 0.5).margin;
    if (a > 0 || b > 0) {
      EXPECT_NEAR(a, b, 1e-9);
      ++near;
    } else {
      EXPECT_LE(std::max(a, b), 0);
    }
  }
  EXPECT_GT(near, 20);
}

TEST(SweptVolumeQueryTest, AmongHundredsTheAnswerIsThatOfAllOneByOne) {
  SweptDraw draw(5);
  const Eigen::Matrix2Xd sole = SoleCorners({}, {0.22, 0.14});
  Scene scene = Hall(300, 2.5, false, &draw);
  SweptVolumeQuery query(CoarseVolumes(), sole, scene);
  // Some obstacles go elsewhere after the tree is made.
  for (int i = 0; i < 300; i += 10) {
    Isometry3d& X_WO = scene.obstacles[static_cast<size_t>(i)].X_WO;
    X_WO.translation() = draw.Point({-4, -4, 0}, {4, 4, 0.4});
    query.SetObstaclePose(i, X_WO);
  }
  std::vector<SweptVolumeQuery> singles;
  for (const Obstacle& o : scene.obstacles) {
    Scene single;
    single.obstacles.push_back(o);
    singles.emplace_back(CoarseVolumes(), sole, single);
  }
  int free = 0;
  for (int k = 0; k < 100; ++k) {
    const int element = draw.Index(CoarseVolumes().set.size());
    const Side support = draw.AnySide();
    const Foothold X_WS = Foothold::Level(draw.Floor(4));
    const bool all = std::ranges::all_of(singles, [&](const SweptVolumeQuery& single) {
      return single.DownIsFree(element, support, X_WS);
    });
    EXPECT_EQ(query.DownIsFree(element, support, X_WS), all);
    free += all;
  }
  EXPECT_GT(free, 5);
  EXPECT_LT(free, 95);
}

TEST(MeshInterior, OfAHollowMeshNothingIsInside) {
  TriangleMesh mesh = FacesOf(MakeBox({2, 2, 2}));
  EXPECT_TRUE(MeshInterior(mesh).Contains({0, 0, 0}));
  const CollisionShape body(MakeBox({0.2, 0.2, 0.2})), solid(mesh);
  const Isometry3d X = Isometry3d::Identity();
  EXPECT_LE(Separate(body, X, solid, X).distance, 0);
  mesh.hollow = true;
  EXPECT_FALSE(MeshInterior(mesh).Contains({0, 0, 0}));
  const CollisionShape room(mesh);
  EXPECT_NEAR(Separate(body, X, room, X).distance, 0.9, 1e-9);
  EXPECT_GE(Separate(body, X, room, X, 0.5).distance, 0.5);
  const CollisionShape around(MakeBox({4, 4, 4}));
  EXPECT_LE(Separate(around, X, room, X).distance, 0) << "a body that holds it touches it";
}

}  // namespace
}  // namespace halfstep
