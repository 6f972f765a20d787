#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "experiments/verify/box_index.h"
#include "experiments/verify/obstacle_path.h"
#include "experiments/verify/played_motion.h"
#include "experiments/verify/solid.h"
#include "experiments/verify/tube_raise.h"
#include "planner/scene/scene.h"

namespace halfstep::verify {

/// Distances of the robot's bodies from obstacles and from each other, by Solid. Obstacles are
/// where they are said to be at a time t of the walk [s], and distances from them are less than
/// that by how far from there they may be. All distances are less by what a tube can take from
/// them. Solids of the ground are obstacles at rest, after those of the scene; a body on a foot
/// need not keep off those whose top is no higher than its sole. Borrows robot and scene. Const but
/// for the count of queries.
class Distances {
 public:
  /// Robot and scene are borrowed.
  Distances(const RobotModel& robot, const Scene& scene, const Tube& tube = {});

  const Scene& scene() const { return scene_; }               ///< as given
  size_t num_bodies() const { return bodies_.size(); }        ///< those of the robot
  size_t num_obstacles() const { return obstacles_.size(); }  ///< those of the scene and solids
  long queries() const { return queries_; }                   ///< distances asked so far

  /// A distance [m] or a lower bound of it. `exact`: the solids themselves were measured.
  struct Result {
    double distance = 0;  ///< [m]
    bool exact = false;   ///< whether the solids themselves were measured
  };
  /// Distance of a body from an obstacle at t [m], less the obstacle's uncertainty. Where by their
  /// bounding volumes it is at least `enough` [m], it is that of these.
  Result FromObstacle(size_t body, size_t obstacle, const Placement& at, double t, double enough);
  /// Whether a body has to keep off an obstacle while the soles are at these heights [m], by
  /// Index(Side). Source: smoothing/README.md, "Solids of the ground".
  bool MustKeepOff(size_t body, size_t obstacle, const std::array<double, 2>& soles) const;
  /// The distance of the outline of a whole foot (Index(Side)), laid flat where its sole is (x, y,
  /// z [m], yaw), from a solid of the ground [m].
  double SoleFromSolid(int side, const Eigen::Vector4d& sole, size_t obstacle);
  /// The least distance of a body from any obstacle that it has to keep off at t [m], or something
  /// at least `enough` when none is nearer than that.
  double FromAll(size_t body, const Placement& at, double t, double enough);
  /// The obstacles that may come within `reach` [m] of a box in W at any time: all others keep
  /// more. In increasing order.
  std::vector<size_t> Near(const Eigen::AlignedBox3d& box_W, double reach) const;
  /// A box in W that holds a body.
  Eigen::AlignedBox3d Around(size_t body, const Placement& at) const;
  /// The distance of two bodies of the robot, as FromObstacle gives it.
  Result OfPair(size_t a, size_t b, const Placement& at, double enough);

  /// A speed that bounds how fast an obstacle takes off such a distance within [begin, end] [m/s].
  double ObstacleSpeed(size_t obstacle, double begin, double end) const {
    return paths_[obstacle].FastestWithin(begin, end);
  }
  /// How far the middle of an obstacle moves from one time to another, and how much its uncertainty
  /// changes, added [m].
  double ObstacleChange(size_t obstacle, double from, double to) const;

  /// Smallest distance of any body from any obstacle at t, and of any watched pair of bodies; at
  /// most `cap` [m].
  double NearestObstacle(const Placement& at, double t, double cap);
  double NearestPair(const Placement& at, double cap);  ///< of any watched pair of bodies

  /// "RLEG_LINK5 - bar", "LLEG_LINK5 - RLEG_LINK5".
  std::string NameOfObstaclePair(size_t body, size_t obstacle) const;
  std::string NameOfPair(size_t a, size_t b) const;  ///< of two bodies

 private:
  static Eigen::AlignedBox3d BoxOf(const Solid& solid, const Eigen::Isometry3d& X_WS);
  static double QuickBound(const Solid& a, const Eigen::Isometry3d& X_a, const Solid& b,
                           const Eigen::Isometry3d& X_b);

  const RobotModel& robot_;
  const Scene& scene_;
  // The solids of the ground as obstacles, which paths_ borrow; shared, so that copies do.
  std::shared_ptr<const std::vector<Obstacle>> of_ground_;
  std::vector<Solid> bodies_, obstacles_;
  std::array<std::vector<Solid>, 2> flat_feet_;  // bodies of a foot, in the sole's plane
  std::vector<ObstaclePath> paths_;
  BodyWays ways_;
  std::vector<size_t> still_, others_;  // obstacles that are known to stay where they are
  BoxIndex around_still_;               // boxes around the former, in W
  long queries_ = 0;
};

}  // namespace halfstep::verify
