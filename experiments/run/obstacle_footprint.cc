#include "experiments/run/obstacle_footprint.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <variant>

#include "wpg/elementary.h"
#include "wpg/geometry/convex_body.h"

namespace halfstep {
namespace {

// How far an obstacle reaches in a direction of W [m].
double Reach(const Obstacle& obstacle, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d d_O = obstacle.X_WO.linear().transpose() * direction;
  const double at = obstacle.X_WO.translation().dot(direction);
  return at + std::visit(
                  [&](const auto& shape) {
                    if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, TriangleMesh>) {
                      return (d_O.transpose() * shape.vertices).maxCoeff();
                    } else {
                      return Support(BodyOf(shape), d_O);
                    }
                  },
                  obstacle.shape);
}

}  // namespace

ObstacleFootprint FootprintOf(const Obstacle& obstacle) {
  constexpr int kDirections = 72;  // of half a turn
  ObstacleFootprint best;
  double least = std::numeric_limits<double>::infinity();
  for (int j = 0; j < kDirections; ++j) {
    const double angle = std::numbers::pi * j / kDirections;
    const Eigen::Vector2d across(Cos(angle), Sin(angle)), along(-across.y(), across.x());
    const auto reach = [&](const Eigen::Vector2d& d) {
      return Reach(obstacle, {d.x(), d.y(), 0.0});
    };
    const ObstacleFootprint here{
        across, along, -reach(-across), reach(across), -reach(-along), reach(along), 0.0};
    if (here.depth() < least - 1e-9) {
      least = here.depth();
      best = here;
    }
  }
  best.top = Reach(obstacle, Eigen::Vector3d::UnitZ());
  return best;
}

bool ObstacleFootprint::IsBetween(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const double a = across.dot(from), b = across.dot(to);
  if (!(std::min(a, b) <= near && far <= std::max(a, b)) || a == b) return false;
  const double share = (0.5 * (near + far) - a) / (b - a);
  const double y = along.dot(from + share * (to - from));
  return left <= y && y <= right;
}

bool LiesAcross(const ObstacleFootprint& print, const Eigen::Vector2d& from,
                const Eigen::Vector2d& to) {
  constexpr int kPoints = 200;
  for (int j = 0; j <= kPoints; ++j) {
    const Eigen::Vector2d p_W = from + (to - from) * j / kPoints;
    const double x = p_W.dot(print.across), y = p_W.dot(print.along);
    if (x >= print.near - 0.01 && x <= print.far + 0.01 && y >= print.left && y <= print.right) {
      return true;
    }
  }
  return false;
}

}  // namespace halfstep
