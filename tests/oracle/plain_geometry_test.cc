// The oracle's distances, soles, ground and scenes against their definitions.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "tests/oracle/nasty_draws.h"
#include "tests/oracle/plain_ground.h"
#include "tests/oracle/plain_robot.h"
#include "tests/oracle/plain_scene.h"
#include "tests/oracle/plain_soles.h"
#include "tests/oracle/walk_truth.h"
#include "tests/places.h"

namespace halfstep::oracle {
namespace {

TEST(MinNormPointTest, BracketsTheDistanceOfBoxesAndNeedles) {
  Draw draw(5);
  for (int k = 0; k < 3000; ++k) {
    ConvexSet a, b;
    const double scale = draw.Logarithmic(1e-4, 1e2);
    for (int n = 1 + draw.Below(12); n > 0; --n) a.points.push_back(draw.Vector(-0.2, 0.2));
    for (int n = 1 + draw.Below(4); n > 0; --n) {
      b.points.push_back(Eigen::Vector3d(draw.Uniform(-0.1, 0.6), 0, 0) +
                         scale * draw.Vector(-1, 1));
    }
    if (draw.Chance(0.3)) b.disc = draw.Logarithmic(1e-4, 0.1);
    const Bracket found = DistanceOf(a, b);
    EXPECT_LE(found.lower, found.upper + 1e-14);
    EXPECT_LT(found.upper - found.lower, b.disc > 0 ? 1e-7 : 1e-11) << k << " " << found.upper;
  }
}

TEST(MinNormPointTest, KnowsTheDistanceFromATiltedDisc) {
  Draw draw(9);
  for (int k = 0; k < 300; ++k) {
    ConvexSet disc, point;
    disc.disc_axis = draw.Vector(-1, 1).normalized();
    disc.points = {draw.Vector(-1, 1)};
    disc.disc = draw.Uniform(0.01, 0.03);
    const double apart = draw.Uniform(0.002, 0.05), beside = draw.Uniform(0, 0.9) * disc.disc;
    point.points = {disc.points[0] + apart * disc.disc_axis +
                    beside * disc.disc_axis.unitOrthogonal()};
    const Bracket found = DistanceOf(point, disc);
    EXPECT_NEAR(found.lower, apart, 1e-12) << k;
    EXPECT_NEAR(found.upper, apart, 1e-12) << k;
  }
}

// Two soles at drawn places and heights, a force, and where its line passes z = 0.
struct DrawnContact {
  std::array<Eigen::Vector4d, 2> feet;
  Eigen::Vector2d size{0.2, 0.12};
  Eigen::Vector3d force, zmp;

  explicit DrawnContact(Draw* draw) {
    for (size_t i = 0; i < 2; ++i) {
      const double y = (i == 0 ? 1 : -1) * draw->Uniform(0, 0.2);
      feet[i] = {draw->Uniform(-0.2, 0.2), y, draw->Uniform(-0.3, 0.3), draw->Uniform(-1, 1)};
    }
    force = {draw->Uniform(-200, 200), draw->Uniform(-200, 200), draw->Uniform(100, 700)};
    zmp = {draw->Uniform(-0.3, 0.3), draw->Uniform(-0.3, 0.3), 0};
  }
  // Corners seen from where the line passes the plane of their sole.
  std::array<Eigen::Vector2d, 4> Seen(size_t i) const {
    Eigen::Vector4d seen = feet[i];
    seen.head<2>() -= (zmp + feet[i][2] / force.z() * force).head<2>();
    return SoleCorners(seen, size);
  }
};

// Pushing forces along f at corners of both soles that have the moment of f on its line but for its
// upright part: three corners are enough, if any are.
TEST(PlainSolesTest, ForcesAtCornersExistWhereTheLineIsInsideTheShadows) {
  Draw draw(21);
  int inside = 0;
  for (int k = 0; k < 400; ++k) {
    const DrawnContact contact(&draw);
    std::vector<Eigen::Vector2d> seen;
    std::vector<Eigen::Vector3d> turns;  // moment of all of f at a corner about a point of its line
    for (size_t i = 0; i < 2; ++i) {
      for (const Eigen::Vector2d& c : contact.Seen(i)) seen.push_back(c);
      for (const Eigen::Vector2d& c : SoleCorners(contact.feet[i], contact.size)) {
        const Eigen::Vector3d corner(c.x(), c.y(), contact.feet[i][2]);
        turns.push_back((corner - contact.zmp).cross(contact.force));
      }
    }
    bool exist = false;
    for (size_t a = 0; a < 8; ++a) {
      for (size_t b = 0; b < a; ++b) {
        for (size_t c = 0; c < b; ++c) {
          Eigen::Matrix3d A;
          A << turns[a].head<2>(), turns[b].head<2>(), turns[c].head<2>(), 1, 1, 1;
          const Eigen::Vector3d w = A.fullPivLu().solve(Eigen::Vector3d(0, 0, 1));
          exist = exist || (w.minCoeff() >= 0 && (A * w - Eigen::Vector3d(0, 0, 1)).norm() < 1e-9);
        }
      }
    }
    EXPECT_EQ(exist, InsideHull(seen, {0, 0}) > 0) << k;
    inside += exist;
  }
  EXPECT_GT(inside, 50);
  EXPECT_LT(inside, 350);
}

// The best section against sections that are hulls of all pairs of corners, at steps of λ.
TEST(PlainSolesTest, TheSectionHoldsTwoPointsAndADisc) {
  Draw draw(22);
  int held = 0;
  for (int k = 0; k < 100; ++k) {
    const DrawnContact contact(&draw);
    const auto left = contact.Seen(0), right = contact.Seen(1);
    double longest = -1;
    for (int step = 0; step <= 50; ++step) {
      std::vector<Eigen::Vector2d> section;
      for (const Eigen::Vector2d& a : left) {
        for (const Eigen::Vector2d& b : right) {
          section.push_back(a + step / 50.0 * (b - a));
        }
      }
      const std::vector<HullSide> sides = HullSides(section);
      for (const HullSide& along : sides) {
        double lever = 10;
        for (const HullSide& side : sides) {
          const double apart = -side.offset;
          lever =
              std::min({lever, apart / std::max(std::abs(side.inwards.dot(along.along)), 0.25)});
        }
        longest = std::max(longest, lever);
      }
    }
    const double found = LongestSectionLever(left, right);
    EXPECT_LT(longest, std::max(found, 0.0) + 1e-12) << k;
    if (found > 0.01) {
      EXPECT_GT(longest, 0.9 * found - 0.002) << k;
    }
    held += found > 0;
  }
  EXPECT_GT(held, 15);
}

TEST(PlainGroundTest, KnowsWhereALevelEnds) {
  const auto square = [](double x, double y, double side) {
    return Polygon{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
  };
  // Two squares of one level side by side, a higher one beyond, a bridge above all.
  std::vector<PlainSurface> surfaces = {
      {.name = "a", .polygon = square(0, 0, 1), .height = 0.45},
      {.name = "b", .polygon = square(1, 0, 1), .height = 3 * 0.15},
      {.name = "c", .polygon = square(2, 0, 1), .height = 0.6},
      {.name = "d", .polygon = square(0, 0, 1), .height = 2, .thickness = 0.1}};
  const PlainGround ground(true, surfaces);
  EXPECT_NEAR(ground.Inside(square(0.9, 0.4, 0.2), 0.45), 0.4, 1e-12);
  EXPECT_NEAR(ground.Inside(square(1.7, 0.4, 0.2), 0.45), 0.1, 1e-12);
  EXPECT_LT(ground.Inside(square(1.9, 0.4, 0.2), 0.45), 0);
  EXPECT_EQ(ground.Inside(square(0.9, 0.4, 0.2), 0.46), -kNever);
  EXPECT_NEAR(ground.Inside(square(-0.3, 0.4, 0.2), 0), 0.1, 1e-12);
  EXPECT_EQ(ground.HeightUnder({1.5, 0.5}), 0.45);
  EXPECT_EQ(ground.HeightUnder({0.5, 0.5}), 2);
  EXPECT_EQ(ground.HeightUnder({-5, 0.5}), 0);
  PlainSurface flight{.name = "flight", .count = 3, .rise = 0.15, .run = 0.3, .width = 1};
  flight.yaw_deg = 90;
  const PlainGround stairs(false, {flight});
  EXPECT_EQ(stairs.HeightUnder({0.1, 0.7}), 0.45);
  EXPECT_EQ(stairs.HeightUnder({0.1, -0.1}), std::nullopt);
  EXPECT_NEAR(stairs.Inside(square(-0.1, 0.35, 0.2), 0.3), 0.05, 1e-12);
}

TEST(PlainSceneTest, KnowsInsideFromOutside) {
  Draw draw(7);
  PlainScene scene;
  for (const SceneKind kind : {SceneKind::kClosedMeshes, SceneKind::kNested}) {
    const PlainRobot robot(InSources("wpg/robots/hrp2.yaml"));
    const WalkPlan plan = DrawPlan(robot, &draw);
    for (const PlainObstacle& o : DrawNastyScene(kind, plan, robot.size(), &draw).obstacles) {
      scene.obstacles.push_back(o);
    }
  }
  const PlacedScene placed(scene, {0, 0, 0});
  for (size_t o = 0; o < placed.size(); ++o) {
    const auto far = placed.Around(o, {50, 60, 70});
    EXPECT_NEAR(far.component, 0, 1e-12);
    EXPECT_FALSE(far.maybe());
  }
}

}  // namespace
}  // namespace halfstep::oracle
