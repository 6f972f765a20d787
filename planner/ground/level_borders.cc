#include "planner/ground/level_borders.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "planner/ground/stretches.h"
#include "wpg/check.h"
#include "wpg/geometry/simple_polygon.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Beside an edge this far, what lies there is asked; places are whole nanometres [m].
constexpr double kBeside = 2e-9;

double FromSegment(const Eigen::Matrix2d& ends, const Eigen::Vector2d& p) {
  const Eigen::Vector2d along = ends.col(1) - ends.col(0);
  const double at = std::clamp(along.dot(p - ends.col(0)) / along.squaredNorm(), 0.0, 1.0);
  return (p - ends.col(0) - at * along).norm();
}

Eigen::AlignedBox3d BoundsOfPoints(const Eigen::Matrix2Xd& points) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector2d& p : points.colwise()) box.extend(Eigen::Vector3d(p.x(), p.y(), 0.0));
  return box;
}

Eigen::Vector3d InPlane(const Eigen::Vector2d& p) { return {p.x(), p.y(), 0.0}; }

double ReachOf(const Eigen::Matrix2Xd& outline) { return outline.colwise().norm().maxCoeff(); }

}  // namespace

LevelBorders::LevelBorders(const Ground& ground) {
  if (ground.OnlyLevel()) return;
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const GroundSolid& solid : ground.Solids()) {
    prisms_.push_back({solid.polygon, solid.top, solid.bottom, solid.bears.value_or(-1)});
    boxes.push_back(BoundsOfPoints(solid.polygon));
  }
  tree_ = BoundsTree(boxes, 4);
  for (const GroundLevel& level : ground.Levels()) {
    const bool everywhere = level.height == ground.Floor();
    if (everywhere) floor_level_ = level.number;
    levels_.push_back(
        {.height = level.height, .everywhere = everywhere, .borders = {}, .tree = {}});
  }
  std::vector<std::vector<int>> bearers(levels_.size());
  for (size_t i = 0; i < prisms_.size(); ++i) {
    if (prisms_[i].bears >= 0) Nth(bearers, prisms_[i].bears).push_back(static_cast<int>(i));
  }
  for (size_t i = 0; i < levels_.size(); ++i) {
    for (const int solid : bearers[i]) AddBorders(solid, &levels_[i], true);
    for (const int solid : InTheWayOf(levels_[i], bearers[i])) {
      AddBorders(solid, &levels_[i], false);
    }
  }
  for (Level& level : levels_) {
    boxes.clear();
    for (const Border& border : level.borders) boxes.push_back(BoundsOfPoints(border.ends));
    level.tree = BoundsTree(boxes, 4);
  }
}

int LevelBorders::LevelAt(double z) const {
  for (size_t i = 0; i < levels_.size(); ++i) {
    if (std::abs(levels_[i].height - z) < 0.5e-9) return static_cast<int>(i);
  }
  return -1;
}

bool LevelBorders::IsInTheWay(const Prism& prism, const Level& level) const {
  return prism.bottom <= level.height && level.height < prism.top;
}

// What is in the way of a level where it bears, or beside that.
std::vector<int> LevelBorders::InTheWayOf(const Level& level,
                                          const std::vector<int>& bearers) const {
  std::set<int> all;
  const auto add = [&](int i) {
    if (IsInTheWay(Nth(prisms_, i), level)) all.insert(i);
  };
  if (level.everywhere) {
    for (int i = 0; i < std::ssize(prisms_); ++i) add(i);
  }
  for (const int bearer : bearers) {
    const Eigen::AlignedBox3d box = BoundsOfPoints(Nth(prisms_, bearer).polygon);
    tree_.ForEachNear(box.center(), 0.5 * box.diagonal().norm() + 2.0 * kBeside, add);
  }
  return {all.begin(), all.end()};
}

// A part of a bearer's edge is a border where just outside no other bears and just inside nothing
// is in the way; where something stands just outside, its own edge is the border. A part of the
// edge of what is in the way is one where the level goes on just outside.
void LevelBorders::AddBorders(int solid, Level* level, bool as_bearer) const {
  const Eigen::Matrix2Xd& polygon = Nth(prisms_, solid).polygon;
  for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
    const Eigen::Vector2d a = polygon.col(i), b = polygon.col((i + 1) % polygon.cols());
    const double length = (b - a).norm();
    const Eigen::Vector2d along = (b - a) / length, out(along.y(), -along.x());
    Stretches bearing_outside, in_the_way_outside, in_the_way_inside;
    tree_.ForEachNear(InPlane(0.5 * (a + b)), 0.5 * length + 2.0 * kBeside, [&](int other) {
      if (other == solid) return;
      const Prism& prism = Nth(prisms_, other);
      const bool bears = &Nth(levels_, std::max(prism.bears, 0)) == level && prism.bears >= 0;
      if (!bears && !IsInTheWay(prism, *level)) return;
      const auto within = [&](double aside) {
        return StretchWithin(prism.polygon, a + aside * out, along, length);
      };
      if (bears) {
        bearing_outside.Add(within(kBeside));
      } else {
        in_the_way_outside.Add(within(kBeside));
        if (as_bearer) in_the_way_inside.Add(within(-kBeside));
      }
    });
    Stretches borders;
    if (as_bearer || level->everywhere) {
      borders.Add(Stretch{0.0, length});
    } else {
      borders = bearing_outside;
    }
    if (as_bearer) borders.Remove(bearing_outside);
    borders.Remove(in_the_way_outside);
    borders.Remove(in_the_way_inside);
    for (const Stretch& part : borders.parts()) {
      Eigen::Matrix2d ends;
      ends << a + part.from * along, a + part.to * along;
      level->borders.push_back({ends, solid});
    }
  }
}

bool LevelBorders::IsOn(const Level& level, const Eigen::Vector2d& point) const {
  bool bears = level.everywhere, in_the_way = false;
  tree_.ForEachNear(InPlane(point), kBeside, [&](int i) {
    const Prism& prism = Nth(prisms_, i);
    const bool of_level = prism.bears >= 0 && &Nth(levels_, prism.bears) == &level;
    if (!of_level && !IsInTheWay(prism, level)) return;
    const double depth = DepthWithin(prism.polygon, point);
    if (of_level) {
      bears = bears || depth >= -kBeside;
    } else {
      in_the_way = in_the_way || depth > kBeside;
    }
  });
  return bears && !in_the_way;
}

bool LevelBorders::AreOn(const Level& level, const Eigen::Matrix2Xd& outline_W) const {
  for (const Eigen::Vector2d& corner : outline_W.colwise()) {
    if (!IsOn(level, corner)) return false;
  }
  return true;
}

// The border for which distance(ends) is least, where that is no less than the distance from
// `center` less `radius`.
template <typename Distance>
LevelBorders::Nearest LevelBorders::NearestBorder(const Level& level, const Eigen::Vector2d& center,
                                                  double radius, const Distance& distance) const {
  Nearest nearest;
  for (const double reach : {radius + 0.1, radius + 1.0, kInfinite}) {
    int found = -1;
    level.tree.ForEachNear(InPlane(center), reach, [&](int i) {
      const Border& border = Nth(level.borders, i);
      const double d = distance(border.ends);
      // The order in which a tree is walked is its own; of equally near ones the first counts.
      if (d < nearest.distance || (d == nearest.distance && i < found)) {
        nearest = {d, border.solid};
        found = i;
      }
    });
    if (nearest.distance <= reach - radius) break;
  }
  return nearest;
}

LevelBorders::Nearest LevelBorders::NearestTo(const Eigen::Matrix2Xd& outline, const Pose2& X_WF,
                                              int number) const {
  HALFSTEP_CHECK(number >= 0 && number < std::ssize(levels_), "level " << number);
  const Level& level = Nth(levels_, number);
  const Eigen::Matrix2Xd outline_W = (X_WF.rotation() * outline).colwise() + X_WF.position();
  Nearest nearest =
      NearestBorder(level, X_WF.position(), ReachOf(outline),
                    [&](const Eigen::Matrix2d& ends) { return PolygonDistance(outline_W, ends); });
  if (nearest.distance > 0.0 && AreOn(level, outline_W)) return nearest;
  // Off the level, in part or wholly.
  constexpr double kTouching = 1e-9;
  Nearest deepest{std::max(-nearest.distance, kTouching), nearest.solid};
  for (const Eigen::Vector2d& corner : outline_W.colwise()) {
    if (IsOn(level, corner)) continue;
    const Nearest off = NearestBorder(
        level, corner, 0.0, [&](const Eigen::Matrix2d& ends) { return FromSegment(ends, corner); });
    if (off.distance > deepest.distance) deepest = off;
  }
  return {-deepest.distance, deepest.solid};
}

std::vector<int> LevelBorders::LevelsNear(const Eigen::Matrix2Xd& outline,
                                          const Pose2& X_WF) const {
  std::set<int, std::greater<>> all;
  if (floor_level_ >= 0) all.insert(floor_level_);
  tree_.ForEachNear(InPlane(X_WF.position()), ReachOf(outline), [&](int i) {
    if (Nth(prisms_, i).bears >= 0) all.insert(Nth(prisms_, i).bears);
  });
  return {all.begin(), all.end()};
}

bool LevelBorders::Bears(const Eigen::Matrix2Xd& outline, const Pose2& X_WF, int number) const {
  HALFSTEP_CHECK(number >= 0 && number < std::ssize(levels_), "level " << number);
  const Level& level = Nth(levels_, number);
  const Eigen::Matrix2Xd outline_W = (X_WF.rotation() * outline).colwise() + X_WF.position();
  if (!AreOn(level, outline_W)) return false;
  bool touches = false;
  level.tree.ForEachNear(InPlane(X_WF.position()), ReachOf(outline), [&](int i) {
    touches = touches || PolygonsTouch(outline_W, Nth(level.borders, i).ends);
  });
  return !touches;
}

}  // namespace halfstep
