// Level surfaces over a floor: which sole stands on what, and how far inside.

#include "planner/ground/level_ground.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "planner/ground/stairs.h"
#include "tests/draws.h"

namespace halfstep {
namespace {

using Eigen::Matrix2Xd;
using Eigen::Vector2d;

constexpr double kAnyHeight = std::numeric_limits<double>::infinity();

Matrix2Xd Box2(double x0, double x1, double y0, double y1) {
  Matrix2Xd corners(2, 4);
  corners << x0, x1, x1, x0, y0, y0, y1, y1;
  return corners;
}

LevelSurface Block(const std::string& name, const Matrix2Xd& polygon, double height,
                   double bottom = 0.0) {
  return {.name = name, .polygon = polygon, .height = height, .bottom = bottom};
}

// 24 cm × 14 cm, with its corners cut.
Matrix2Xd Sole() {
  Matrix2Xd sole(2, 6);
  sole << 0.12, 0.12, 0.09, -0.12, -0.12, -0.10, -0.06, 0.06, 0.07, 0.07, -0.05, -0.07;
  return sole;
}

std::optional<double> HeightAt(const Ground& ground, const Pose2& X_WF, double below = kAnyHeight) {
  const auto level = ground.LevelUnder(Sole(), X_WF, below);
  return level ? std::optional(level->height) : std::nullopt;
}

TEST(LevelGround, LevelsAreEqualWhenTheirNanometresAre) {
  const Stairs stairs{.X_WA = {0, 0, 0}, .rise = 0.15, .run = 0.3, .width = 2.0, .count = 3};
  std::vector<LevelSurface> surfaces = TreadsOf("flight", stairs, 0.0);
  EXPECT_NE(3 * 0.15, 0.45);  // as doubles
  surfaces.push_back(Block("landing", Box2(0.9, 2.0, -1, 1), 0.45));
  const LevelGround ground(surfaces, true);
  ASSERT_EQ(ground.Levels().size(), 4u);
  EXPECT_EQ(ground.Levels()[3], (GroundLevel{3, 0.45}));
  EXPECT_EQ(ground.Solids()[2].bears, 3);
  EXPECT_EQ(ground.Solids()[3].bears, 3);
  // On both at once.
  EXPECT_EQ(HeightAt(ground, {0.9, 0, 0.3}), 0.45);
  surfaces.back().height = 0.450000002;
  const LevelGround apart(surfaces, true);
  EXPECT_EQ(apart.Levels().size(), 5u);
  EXPECT_EQ(HeightAt(apart, {0.9, 0, 0.3}), std::nullopt);
}

TEST(LevelGround, ASoleStandsAcrossSurfacesThatTouchAndNotAcrossAGap) {
  for (const double yaw : {0.0, 0.4, 1.9}) {
    const Pose2 X{0.3, -0.2, yaw};
    const auto moved = [&X](const Matrix2Xd& p) -> Matrix2Xd {
      return (X.rotation() * p).colwise() + X.position();
    };
    const auto ground = [&](double gap) {
      // Three that meet in a T, one of them larger than what it touches.
      return LevelGround({Block("a", moved(Box2(-0.5, 0, -1, 1)), 0.1),
                          Block("b", moved(Box2(gap, 0.5, -0.7, 0.1)), 0.1),
                          Block("c", moved(Box2(gap, 0.5, 0.1, 1.2)), 0.1)},
                         true);
    };
    EXPECT_EQ(HeightAt(ground(0.0), X * Pose2{0.0, 0.1, 0.2}), 0.1) << yaw;
    EXPECT_EQ(HeightAt(ground(-0.05), X * Pose2{0.0, 0.1, 0.2}), 0.1) << yaw;  // they overlap
    EXPECT_EQ(HeightAt(ground(1e-4), X * Pose2{0.0, 0.1, 0.2}), std::nullopt) << yaw;
    EXPECT_EQ(HeightAt(ground(1e-4), X * Pose2{-0.2, 0.1, 0.2}), 0.1) << yaw;
    EXPECT_EQ(HeightAt(ground(0.0), X * Pose2{0.3, -0.7, 0.2}), std::nullopt) << yaw;
  }
}

TEST(LevelGround, SolidsThatReachThroughALevelAreInItsWay) {
  const LevelGround ground(
      {Block("platform", Box2(0, 2, -1, 1), 0.2), Block("on_it", Box2(1, 1.5, -1, 1), 0.3, 0.2),
       Block("bridge", Box2(-2, -1, -1, 1), 0.9, 0.8)},
      true);
  EXPECT_EQ(HeightAt(ground, {0.5, 0, 0}), 0.2);
  EXPECT_EQ(HeightAt(ground, {0.95, 0, 0}), std::nullopt);
  EXPECT_EQ(HeightAt(ground, {1.25, 0, 0}), 0.3);
  EXPECT_EQ(HeightAt(ground, {1.25, 0, 0}, 0.25), std::nullopt);  // below is solid
  EXPECT_EQ(HeightAt(ground, {-1.5, 0, 0}), 0.9);
  EXPECT_EQ(HeightAt(ground, {-1.5, 0, 0}, 0.85), 0.0);  // under the bridge
  EXPECT_EQ(HeightAt(ground, {-1.0, 0, 0}), 0.0);        // half below it, and not on it
  EXPECT_EQ(HeightAt(ground, {0.05, 0, 0}), std::nullopt);
  EXPECT_EQ(HeightAt(ground, {0.5, 0, 0}, -0.1), std::nullopt);
  const LevelGround stone({Block("stone", Box2(-0.2, 0.2, -0.2, 0.2), 0.05, -0.1)}, false);
  EXPECT_EQ(stone.Levels().size(), 1u);
  EXPECT_EQ(stone.Floor(), -kAnyHeight);
  EXPECT_EQ(HeightAt(stone, {0, 0, 0}), 0.05);
  EXPECT_EQ(HeightAt(stone, {1, 0, 0}), std::nullopt);
}

TEST(LevelGround, LevelsHaveTheNamesOfTheirSurfaces) {
  LevelSurface pole = Block("pole", Box2(5, 5.1, 0, 0.1), 1.0);
  pole.bears = false;
  const LevelGround ground({Block("low", Box2(0, 1, 0, 1), 0.1), pole}, true);
  EXPECT_EQ(LevelNamed(ground, "low"), ground.Levels()[1]);
  EXPECT_EQ(LevelNamed(ground, "floor"), ground.Levels()[0]);
  EXPECT_EQ(LevelNamed(ground, "pole"), std::nullopt);
  EXPECT_EQ(ground.Levels().size(), 2u);
  EXPECT_EQ(LevelNamed(FlatGround(), "floor"), (GroundLevel{0, 0.0}));
}

TEST(LevelGround, RefusesWhatIsNoPrism) {
  const auto make = [](const LevelSurface& surface, bool floor) {
    return [=] { LevelGround({surface}, floor); };
  };
  EXPECT_THROW(make(Block("flat", Box2(0, 1, 0, 1), 0.1, 0.1), true)(), std::logic_error);
  EXPECT_THROW(make(Block("deep", Box2(0, 1, 0, 1), 0.1, -0.1), true)(), std::logic_error);
  EXPECT_NO_THROW(make(Block("deep", Box2(0, 1, 0, 1), 0.1, -0.1), false)());
  EXPECT_THROW(make(Block("clockwise", Box2(1, 0, 0, 1), 0.1), true)(), std::logic_error);
  EXPECT_THROW(LevelGround({}, true), std::logic_error);
}

TEST(CornersOf, LeavesOutWhatLiesOnALine) {
  Matrix2Xd polygon(2, 6);
  polygon << 0, 0.5, 1, 1, 0, 0, 0, 0, 0, 1, 1, 0.5;
  EXPECT_EQ(CornersOf(polygon).cols(), 4);
  EXPECT_EQ(WhyNotConvex(CornersOf(polygon)), "");
  polygon(1, 1) = 0.2;
  EXPECT_THAT(WhyNotConvex(CornersOf(polygon)), testing::HasSubstr("(0.5, 0.2) points inwards"));
}

// Rectangles of few heights that lie across each other.
std::vector<LevelSurface> DrawSurfaces(std::mt19937* random) {
  std::vector<LevelSurface> surfaces;
  for (int i = 0; i < 9; ++i) {
    const Pose2 X{Uniform(random, -0.7, 0.7), Uniform(random, -0.7, 0.7), Uniform(random, -3, 3)};
    const double half_x = Uniform(random, 0.1, 0.4), half_y = Uniform(random, 0.1, 0.4);
    const double height = 0.1 * std::ceil(Uniform(random, 0, 3));
    surfaces.push_back(
        Block("s" + std::to_string(i),
              (X.rotation() * Box2(-half_x, half_x, -half_y, half_y)).colwise() + X.position(),
              height, i % 3 == 0 ? height - 0.05 : 0.0));
  }
  return surfaces;
}

// By the definition, without any of what is tested.
bool IsOn(const std::vector<LevelSurface>& surfaces, double height, const Vector2d& p) {
  bool bears = height == 0.0;
  for (const LevelSurface& s : surfaces) {
    bool inside = true;
    for (Eigen::Index i = 0; i < s.polygon.cols(); ++i) {
      const Vector2d a = s.polygon.col(i), b = s.polygon.col((i + 1) % s.polygon.cols());
      inside = inside && (b - a).x() * (p - a).y() - (b - a).y() * (p - a).x() >= 0.0;
    }
    if (!inside) continue;
    if (std::abs(s.height - height) < 1e-6) {
      bears = true;
    } else if (s.bottom < height + 1e-6 && height < s.height) {
      return false;
    }
  }
  return bears;
}

double Distance(const Matrix2Xd& convex, const Vector2d& p) {
  double least = kAnyHeight;
  bool inside = true;
  for (Eigen::Index i = 0; i < convex.cols(); ++i) {
    const Vector2d a = convex.col(i), e = convex.col((i + 1) % convex.cols()) - a;
    inside = inside && e.x() * (p - a).y() - e.y() * (p - a).x() >= 0.0;
    const double t = std::min(1.0, std::max(0.0, e.dot(p - a) / e.squaredNorm()));
    least = std::min(least, (p - a - t * e).norm());
  }
  return inside ? 0.0 : least;
}

// No place off the level is nearer than what is told, and there is one about there.
TEST(LevelBorders, TheDistanceIsThatOfTheNearestPlaceOffTheLevel) {
  constexpr double kStep = 0.006;
  std::mt19937 random(44);
  int inside = 0, off = 0, tight = 0;
  for (int draw = 0; draw < Draws(40); ++draw) {
    const std::vector<LevelSurface> surfaces = DrawSurfaces(&random);
    const LevelGround ground(surfaces, true);
    const LevelBorders borders(ground);
    for (int k = 0; k < 12; ++k) {
      const Pose2 X{Uniform(&random, -1, 1), Uniform(&random, -1, 1), Uniform(&random, -3, 3)};
      const Matrix2Xd sole = 0.4 * Sole();
      const Matrix2Xd sole_W = (X.rotation() * sole).colwise() + X.position();
      for (const GroundLevel& level : ground.Levels()) {
        const double told = borders.NearestTo(sole, X, level.number).distance;
        double nearest = kAnyHeight;  // of places off the level, on a grid
        for (double x = -0.15; x <= 0.15; x += kStep) {
          for (double y = -0.15; y <= 0.15; y += kStep) {
            const Vector2d p = X.position() + Vector2d(x, y);
            if (!IsOn(surfaces, level.height, p)) nearest = std::min(nearest, Distance(sole_W, p));
          }
        }
        EXPECT_EQ(borders.Bears(sole, X, level.number), told > 0.0);
        if (told > 0.0) {
          ++inside;
          EXPECT_GT(nearest, told - 1e-8);
          if (told < 0.08) tight += nearest < told + 2 * kStep ? 1 : -10;
        } else {
          ++off;
          // A sliver between grid points may lie in the sole.
          if (told < -2 * kStep) {
            EXPECT_EQ(nearest, 0.0) << told;
          }
        }
      }
    }
  }
  EXPECT_GT(inside, Draws(40));
  EXPECT_GT(off, Draws(40));
  EXPECT_GT(tight, 0);
}

TEST(LevelBorders, MirroredTurnedAndMovedGroundHasTheSameDistances) {
  std::mt19937 random(45);
  for (int draw = 0; draw < Draws(20); ++draw) {
    const std::vector<LevelSurface> surfaces = DrawSurfaces(&random);
    const Pose2 moved{0.3, -2.0, 0.7};
    std::vector<LevelSurface> others = surfaces, mirrored = surfaces;
    for (size_t i = 0; i < surfaces.size(); ++i) {
      others[i].polygon = (moved.rotation() * surfaces[i].polygon).colwise() + moved.position();
      mirrored[i].polygon = surfaces[i].polygon.rowwise().reverse().eval();
      mirrored[i].polygon.row(1) *= -1.0;
    }
    const LevelGround ground(surfaces, true), other(others, true), mirror(mirrored, true);
    const LevelBorders a(ground), b(other), c(mirror);
    Matrix2Xd sole_mirrored = Sole().rowwise().reverse();
    sole_mirrored.row(1) *= -1.0;
    for (int k = 0; k < 20; ++k) {
      const Pose2 X{Uniform(&random, -1, 1), Uniform(&random, -1, 1), Uniform(&random, -3, 3)};
      for (const GroundLevel& level : ground.Levels()) {
        const double told = a.NearestTo(Sole(), X, level.number).distance;
        // Places are rounded to nanometres.
        EXPECT_NEAR(b.NearestTo(Sole(), moved * X, level.number).distance, told, 1e-7);
        EXPECT_NEAR(c.NearestTo(sole_mirrored, X.Mirrored(), level.number).distance, told, 1e-7);
      }
    }
  }
}

TEST(LevelBorders, TellsWhatIsNearestAndHowFarASoleReachesOver) {
  const LevelGround ground(
      {Block("tread", Box2(0, 0.4, -1, 1), 0.1), Block("next", Box2(0.4, 0.8, -1, 1), 0.2)}, true);
  const LevelBorders borders(ground);
  const Matrix2Xd sole = Box2(-0.1, 0.1, -0.05, 0.05);
  const auto at = [&](double x, int level) { return borders.NearestTo(sole, {x, 0, 0}, level); };
  EXPECT_NEAR(at(0.12, 1).distance, 0.02, 1e-12);
  EXPECT_EQ(at(0.12, 1).solid, 0);
  EXPECT_NEAR(at(0.25, 1).distance, 0.05, 1e-12);
  EXPECT_EQ(at(0.25, 1).solid, 1);  // the riser of the next
  EXPECT_NEAR(at(0.08, 1).distance, -0.02, 1e-9);
  EXPECT_NEAR(at(-0.13, 0).distance, 0.03, 1e-12);
  EXPECT_EQ(at(-0.13, 0).solid, 0);
  EXPECT_NEAR(at(-0.09, 0).distance, -0.01, 1e-9);
  EXPECT_EQ(at(0.1, 1).distance, -1e-9);  // touches
  EXPECT_EQ(borders.LevelAt(0.1), 1);
  EXPECT_EQ(borders.LevelAt(0.1 + 1e-12), 1);
  EXPECT_EQ(borders.LevelAt(0.1 + 1e-6), -1);
  EXPECT_TRUE(LevelBorders(FlatGround()).empty());
}

// Where the tread ends below the next, none of its own edge is a border: a sole there is as deep in
// the next as that is.
TEST(LevelBorders, AnEdgeBelowWhatIsInTheWayIsNone) {
  const LevelGround ground(
      {Block("tread", Box2(0, 1, -1, 1), 0.1), Block("next", Box2(0.6, 1, -1, 1), 0.2)}, true);
  const LevelBorders borders(ground);
  const LevelBorders::Nearest nearest =
      borders.NearestTo(Box2(-0.1, 0.1, -0.05, 0.05), {0.85, 0, 0}, 1);
  EXPECT_NEAR(nearest.distance, -0.35, 1e-12);
  EXPECT_EQ(nearest.solid, 1);
}

// Places are whole nanometres: a sole may be one of them inside a border, and not one beyond it.
TEST(LevelBorders, ANanometreFromABorderIsInside) {
  const LevelGround ground(
      {Block("tread", Box2(0, 0.4, -1, 1), 0.1), Block("same", Box2(0.4, 0.8, -1, 1), 0.1),
       Block("next", Box2(0.8, 1.2, -1, 1), 0.2)},
      true);
  const LevelBorders borders(ground);
  const Matrix2Xd sole = Box2(-0.1, 0.1, -0.05, 0.05);
  for (const double border : {0.1, 0.7}) {  // where the sole is then
    const double inwards = border < 0.4 ? 1.0 : -1.0;
    for (const int nanometres : {-1, 1, 3}) {
      const Pose2 X{border + 1e-9 * inwards * nanometres, 0, 0};
      const double told = borders.NearestTo(sole, X, 1).distance;
      EXPECT_NEAR(told, nanometres > 0 ? 1e-9 * nanometres : -1e-9, 1e-12) << X.x;
      EXPECT_EQ(borders.Bears(sole, X, 1), nanometres > 0) << X.x;
    }
  }
  // Corners on the edge that two surfaces share.
  EXPECT_NEAR(borders.NearestTo(sole, {0.5, 0, 0}, 1).distance, 0.2, 1e-12);
}

}  // namespace
}  // namespace halfstep
