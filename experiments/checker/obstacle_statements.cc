// Distances from a scene's obstacles.
#include <algorithm>
#include <cmath>

#include "experiments/checker/walk_statements.h"
#include "wpg/nth.h"

namespace halfstep::checker {
namespace {

constexpr double kFarther = 0.01;  // by which a hull is farther than demanded [m]

// The frame of an obstacle on an interval that holds no time of a waypoint: it goes straight from
// one to the next, and turns steadily about the vertical.
FrameIn<Curve> PlaceOf(const Obstacle& obstacle, const WalkState& state) {
  FrameIn<Curve> X_WO = FrameOf<Curve>(obstacle.X_WO);
  if (obstacle.motion.waypoints.empty()) return X_WO;
  ObstacleMotion::Waypoint from{.t = 0.0, .translation = obstacle.X_WO.translation()};
  for (const ObstacleMotion::Waypoint& to : obstacle.motion.waypoints) {
    if (to.t <= state.middle()) {
      from = to;
      continue;
    }
    const Interval rate = Interval(1.0) / (Interval(to.t) - Interval(from.t));
    Curve share;
    share.h = state.h();
    share.at = {(Interval(state.middle()) - Interval(from.t)) * rate, rate, 0.0};
    share.Enclose();
    const auto between = [&](double a, double b) {
      return Curve(a) + (Interval(b) - Interval(a)) * share;
    };
    const auto [s, c] = SinCosOf(between(from.yaw, to.yaw));
    X_WO = TurnAbout(Eigen::Vector3d::UnitZ(), s, c) * X_WO;
    for (Eigen::Index i = 0; i < 3; ++i) {
      Nth(X_WO.p, i) = between(from.translation[i], to.translation[i]);
    }
    return X_WO;
  }
  // At the last one.
  const auto [s, c] = SinCosOf(Curve(from.yaw));
  X_WO = TurnAbout(Eigen::Vector3d::UnitZ(), s, c) * X_WO;
  X_WO.p = VectorOf<Curve>(from.translation);
  return X_WO;
}

// How far a point of it may be from there: error + speed·min(|t − t_m|, horizon) [m].
double FarthestAway(const ObstacleMotion& motion, const WalkState& state) {
  if (motion.speed == 0.0) return motion.error;
  const double since = Above(std::abs(state.middle() - motion.measured_at)) + state.h();
  return Above(motion.error + Above(motion.speed * std::min(Above(since), motion.horizon)));
}

}  // namespace

// A mesh is left alone by a body that meets no triangle and of which a point is not inside.
Kept WalkStatements::FromMesh(WalkStatement* statement, const FrameIn<Curve>& X_WO,
                              const Placed& moving, double demanded) const {
  const MeshTree& mesh = *meshes_[statement->b];
  const double least = std::max(demanded, kNoTouch);
  const FrameIn<Curve> X_OB = X_WO.Inverse() * moving.X_W;
  Kept kept{least, least};
  for (const ConvexBody& triangle :
       mesh.Near(CenterAt(X_OB, moving.shape), Above(moving.shape.radius + least))) {
    Eigen::Vector3d direction(0, 0, 0);
    kept = Least(
        kept, Apart({triangle, X_WO, CenterAt(X_WO, triangle)}, moving, least, &direction, false));
  }
  if (kept.bound < least) return kept;
  const VectorIn<Curve> point = X_OB * VectorOf<Curve>(moving.shape.vertices.col(0));
  if (!mesh.IsOutside({point[0].at[0], point[1].at[0], point[2].at[0]})) return {-1.0, -1.0};
  statement->in_parts = true;
  return kept;
}

Kept WalkStatements::FromObstacle(WalkStatement* statement, const Placed& moving,
                                  const WalkState& state) const {
  const Obstacle& obstacle = scene_.obstacles[statement->b];
  const ConvexBody& shape = obstacles_[statement->b];
  const FrameIn<Curve> X_WO = PlaceOf(obstacle, state);
  const double away = FarthestAway(obstacle.motion, state);
  const double demanded = Above(statement->demanded + away);
  Kept kept = Apart({shape, X_WO, CenterAt(X_WO, shape)}, moving, demanded, &statement->direction,
                    statement->told);
  // Where the hull is farther, shorter intervals will tell.
  if (meshes_[statement->b] && kept.bound < demanded && kept.value < demanded + kFarther) {
    kept = FromMesh(statement, X_WO, moving, demanded);
  }
  return {checker::Below(kept.bound - away), kept.value - away, kept.hint_missing};
}

}  // namespace halfstep::checker
