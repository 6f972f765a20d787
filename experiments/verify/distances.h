#pragma once

#include <string>
#include <vector>

#include "experiments/verify/played_motion.h"
#include "experiments/verify/solid.h"
#include "planner/scene/scene.h"

namespace halfstep::verify {

/// Distances of the robot's bodies from obstacles and from each other, by Solid.
/// Borrows robot and scene. Const but for the count of queries.
class Distances {
 public:
  Distances(const RobotModel& robot, const Scene& scene);

  const Scene& scene() const { return scene_; }
  size_t num_bodies() const { return bodies_.size(); }
  size_t num_obstacles() const { return obstacles_.size(); }
  long queries() const { return queries_; }

  /// A distance [m] or a lower bound of it. `exact`: the solids themselves were measured.
  struct Result {
    double distance = 0;
    bool exact = false;
  };
  /// Distance of a body from an obstacle [m]. Where their bounding volumes are at least `enough`
  /// [m] apart, it is the distance of these.
  Result FromObstacle(size_t body, size_t obstacle, const Placement& at, double enough);
  /// The same for two bodies of the robot.
  Result OfPair(size_t a, size_t b, const Placement& at, double enough);

  /// Smallest distance of any body from any obstacle, and of any watched pair of bodies; at most
  /// `horizon` [m].
  double NearestObstacle(const Placement& at, double horizon);
  double NearestPair(const Placement& at, double horizon);

  /// How far the program's distances may be from these [m]: its slabs and its meshes may be 1e-6 m
  /// too near (planner/collision/separation.h).
  static constexpr double kAccuracy = 2e-6;

  /// "RLEG_LINK5 - bar", "LLEG_LINK5 - RLEG_LINK5".
  std::string NameOfObstaclePair(size_t body, size_t obstacle) const;
  std::string NameOfPair(size_t a, size_t b) const;

 private:
  static double QuickBound(const Solid& a, const Eigen::Isometry3d& X_a, const Solid& b,
                           const Eigen::Isometry3d& X_b);

  const RobotModel& robot_;
  const Scene& scene_;
  std::vector<Solid> bodies_, obstacles_;
  long queries_ = 0;
};

}  // namespace halfstep::verify
