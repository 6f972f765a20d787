// What queries answer by culling, against distances one by one.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "planner/collision/collision_world.h"
#include "planner/collision/separation.h"
#include "planner/collision/triangle_tree.h"
#include "planner/swept/box_tree_query.h"
#include "planner/swept/swept_volume_query.h"
#include "tests/draws.h"
#include "tests/planner/swept_volume_draws.h"
#include "wpg/geometry/support_polygon.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d Posed(const Eigen::Matrix3d& R, const Vector3d& p) {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = R;
  X.translation() = p;
  return X;
}

// Obstacles of every kind that a query tells apart: balls, capsules and cylinders (round), boxes,
// hulls (a mesh) with as many corners as a box, with more, and of one edge off its middle.
Shape DrawShape(int kind, SweptDraw* draw) {
  const double r = draw->Uniform(0.02, 0.2), l = draw->Uniform(0.02, 0.3);
  if (kind == 0) return Sphere{r};
  if (kind == 1) return Capsule{r, l};
  if (kind == 2) return Cylinder{r, l};
  if (kind == 3) return Box{{r, l, draw->Uniform(0.02, 0.3)}};
  Eigen::Matrix3Xd points(3, kind == 4 ? 8 : 12);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    points.col(i) = draw->Direction().cwiseProduct(Vector3d(r, l, 0.1));
  }
  return MakeHull(points);
}

// An obstacle is pushed a millimetre into a solid box of a volume, and the answer is no; it is
// pulled out of the nearest one by 0.1 mm, and the answer is yes. Eight others stand far off,
// before it in the list.
TEST(QueryOracle, AnswersAsTheSolidBoxesDo) {
  const SweptVolumes& volumes = CoarseVolumes();
  SweptDraw draw(31);
  Scene scene;
  for (int i = 0; i < 8; ++i) {
    scene.obstacles.push_back(
        {"far", Sphere{0.1}, Posed(Eigen::Matrix3d::Identity(), {20.0 + i, 0, 0})});
  }
  const BoxTree& tree = *volumes.down[0];
  std::vector<CollisionShape> boxes;
  std::vector<Isometry3d> poses;
  for (const auto& box : tree.SolidBoxes()) {
    const Vector3d lower = tree.Corner(box.lower), upper = tree.Corner(box.upper);
    boxes.emplace_back(MakeBox(upper - lower));
    poses.push_back(Posed(Eigen::Matrix3d::Identity(), 0.5 * (lower + upper)));
  }
  int refused = 0, free = 0;
  for (int trial = 0; trial < 12 * Draws(20); ++trial) {
    const Shape shape = DrawShape(trial % 6, &draw);
    const CollisionShape obstacle(shape);
    const Eigen::Matrix3d R = draw.Turn(trial % 12 < 6);
    // From outside towards the middle of a box, up to where the nearest box is touched.
    const size_t aim = static_cast<size_t>(draw.Index(static_cast<int>(boxes.size())));
    const Vector3d way = draw.Direction();
    Vector3d p = poses[aim].translation() + 3.0 * way;
    const auto distance_at = [&](const Vector3d& at) {
      double nearest = 1e9;
      for (size_t b = 0; b < boxes.size(); ++b) {
        const double spheres = (at + R * obstacle.center() - poses[b].translation()).norm() -
                               obstacle.radius() - boxes[b].radius();
        if (spheres >= nearest) continue;
        nearest = std::min(nearest, Separate(obstacle, Posed(R, at), boxes[b], poses[b]).distance);
      }
      return nearest;
    };
    for (int step = 0; step < 60; ++step) {
      const double nearest = distance_at(p);
      if (nearest < 1e-4) break;
      p -= (nearest - 0.5e-4) * way;
    }
    const bool mirrored = trial % 2 == 1;
    const Foothold X_WS = Foothold::Level(draw.Floor(0.5));
    const auto ask = [&](const Vector3d& at) {
      Isometry3d X_SO = Posed(R, at);
      Obstacle placed{"near", shape, X_SO};
      if (mirrored) {  // round shapes and boxes are their own mirror images
        const Eigen::DiagonalMatrix<double, 3> mirror(1, -1, 1);
        X_SO.linear() = (mirror * X_SO.linear() * mirror).eval();
        X_SO.translation().y() *= -1.0;
      }
      placed.X_WO = ToIsometry(X_WS) * X_SO;
      Scene with = scene;
      with.obstacles.push_back(placed);
      const SweptVolumeQuery query(volumes, SoleCorners({}, {0.22, 0.14}), with);
      return query.DownIsFree(0, mirrored ? Side::kRight : Side::kLeft, X_WS);
    };
    if (mirrored && trial % 6 >= 4) continue;
    const Vector3d in = p - 1e-3 * way, out = p + 1e-4 * way;
    if (distance_at(in) < -1e-5) {
      EXPECT_FALSE(ask(in)) << "kind " << trial % 6;
      ++refused;
    }
    if (distance_at(out) > 2e-5) free += ask(out);
  }
  EXPECT_GT(refused, Draws(150));
  EXPECT_GT(free, Draws(100));
}

// One solid box; round bodies and triangles beyond each of its six faces meet it when it is larger
// by more than the gap, and not by less.
TEST(QueryOracle, ExtraIsAddedOnAllSides) {
  VoxelGrid grid({0.0, 0.0, 0.0}, {0.1, 0.2, 0.3}, 0.05);
  for (int x = 1; x < 3; ++x) grid.Occupy(x, 2, 3);
  const BoxTree tree = BoxTree::Build(grid);
  const Vector3d lower = tree.Lower(), upper = tree.Upper(), middle = 0.5 * (lower + upper);
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  const double radius = 0.03, gap = 0.01;
  const ConvexBody ball = MakeBox(Vector3d::Constant(2.0 * radius));
  const TriangleTree mesh(FacesOf(ball));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vector3d center = middle;
      center[axis] = (side < 0 ? lower : upper)[axis] + side * (gap + radius);
      for (const double more : {-1e-4, 1e-4}) {
        EXPECT_EQ(Meets(tree, {.ball_radius = radius}, center, axes, gap + more), more > 0);
        EXPECT_EQ(Meets(tree, mesh, center, axes, gap + more), more > 0);
      }
    }
  }
}

// Cylinders that barely reach into a box with their rim: projections come near only slowly.
TEST(QueryOracle, MeetsWhatBarelyReachesIn) {
  VoxelGrid grid({0.0, 0.0, 0.0}, {0.1, 0.1, 0.1}, 0.1);
  grid.Occupy(1, 1, 1);
  const BoxTree tree = BoxTree::Build(grid);
  const Vector3d lower = tree.Lower(), upper = tree.Upper();
  const CollisionShape box(MakeBox(upper - lower));
  const Isometry3d X_WBox = Posed(Eigen::Matrix3d::Identity(), 0.5 * (lower + upper));
  SweptDraw draw(32);
  for (int i = 0; i < 2000; ++i) {
    const RoundBody body{.half_length = draw.Uniform(0.001, 0.5),
                         .disc_radius = draw.Uniform(0.001, 1.0)};
    const CollisionShape cylinder(MakeCylinder(body.disc_radius, 2.0 * body.half_length));
    const Eigen::Matrix3d R = draw.Turn(false);
    const Vector3d way = draw.Direction();
    Vector3d p = X_WBox.translation() + 3.0 * way;
    for (int step = 0; step < 40; ++step) {
      const Separation s = Separate(cylinder, Posed(R, p), box, X_WBox);
      const double along = std::max(1e-3, s.normal_W.dot(way));
      if (s.distance < 1e-9) break;
      p -= s.distance / along * way;
    }
    const Vector3d in = p - 1e-7 * way;
    if (Separate(cylinder, Posed(R, in), box, X_WBox).distance > -1e-9) continue;
    EXPECT_TRUE(Meets(tree, body, in, R, 0.0)) << i;
  }
}

TEST(QueryOracle, NodesOfTriangleTreesHoldTheirTriangles) {
  SweptDraw draw(33);
  for (int trial = 0; trial < 10; ++trial) {
    Eigen::Matrix3Xd points(3, 200);
    for (Eigen::Index i = 0; i < points.cols(); ++i) points.col(i) = 10.0 * draw.Direction();
    const TriangleTree tree(FacesOf(MakeHull(points)));
    for (const TriangleTree::Node& node : tree.nodes) {
      for (int32_t i = node.first; i < node.first + node.count; ++i) {
        const Eigen::Matrix3d off =
            (tree.triangles[static_cast<size_t>(i)].colwise() - node.center).cwiseAbs();
        EXPECT_TRUE((off.rowwise().maxCoeff().array() <= node.half.array()).all());
      }
    }
  }
}

// A ball beside each face of a box: its distance is known, and culling must not lose it.
TEST(QueryOracle, ACollisionWorldCullsNothingThatIsNear) {
  Scene scene;
  const Vector3d half(0.1, 0.2, 0.3);
  scene.obstacles.push_back(
      {"box", MakeBox(2.0 * half), Posed(Eigen::Matrix3d::Identity(), {3.0, -2.0, 0.5})});
  const CollisionWorld world(scene);
  const CollisionShape ball(MakeSphere(0.05));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const double distance = 0.02;
      Vector3d p(3.0, -2.0, 0.5);
      p[axis] += side * (half[axis] + 0.05 + distance);
      const Isometry3d X_WB = Posed(Eigen::Matrix3d::Identity(), p);
      EXPECT_NEAR(world.FindNearest(ball, X_WB, 0.0, distance + 1e-6).separation.distance, distance,
                  1e-9);
      CollisionWorld::Scratch scratch;
      EXPECT_FALSE(world.Clears(ball, X_WB, 0.0, distance + 1e-6, &scratch));
      EXPECT_TRUE(world.Clears(ball, X_WB, 0.0, distance - 1e-6, &scratch));
    }
  }
  // A small ball deep inside is found below a negative cap, too.
  const CollisionShape small(MakeSphere(0.001));
  const Isometry3d inside = Posed(Eigen::Matrix3d::Identity(), {3.0, -2.0, 0.5});
  const auto nearest = world.FindNearest(small, inside, 0.0, -0.01);
  EXPECT_EQ(nearest.obstacle, 0);
  EXPECT_LT(nearest.separation.distance, -0.05);
}

}  // namespace
}  // namespace halfstep
