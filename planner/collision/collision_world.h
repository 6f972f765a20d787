#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "planner/collision/separation.h"
#include "planner/scene/scene.h"

namespace halfstep {

/// The obstacles of a scene, prepared for queries about convex bodies at a time t of the walk [s].
/// Queries are const and their scratch is the caller's, so one world serves many threads. A pose or
/// a time that is not finite throws std::logic_error.
class CollisionWorld {
 public:
  /// The directions that separated a body from each obstacle in earlier queries. Most neighbouring
  /// instants are decided by them, without a distance query. Use one scratch for each body and
  /// thread.
  struct Scratch {
    std::vector<Eigen::Vector3d> normals_W;  ///< by obstacle; zero: none yet.
  };
  struct Nearest {
    int obstacle = -1;      ///< index into the scene, −1: none within the horizon.
    Separation separation;  ///< from the obstacle to the body; distance = horizon when none.
  };

  /// Precondition: finite obstacle poses (std::logic_error).
  explicit CollisionWorld(const Scene& scene);

  int num_obstacles() const { return static_cast<int>(entries_.size()); }
  /// A speed that no point of any obstacle exceeds [m/s] (Scene::speed).
  double speed() const { return speed_; }

  /// The obstacle that is nearest at t to the body at X_WB, among those nearer than `horizon` [m].
  Nearest FindNearest(const CollisionShape& body, const Eigen::Isometry3d& X_WB, double t,
                      double horizon) const;

  /// Whether every obstacle is at t at least `clearance` [m] away from the body at X_WB. A lower
  /// bound of the distance decides, so true is proved.
  bool Clears(const CollisionShape& body, const Eigen::Isometry3d& X_WB, double t, double clearance,
              Scratch* scratch) const;

 private:
  // How far from its bounds at t = 0 an obstacle may be at most [m].
  double MovedAt(double t) const;

  struct Entry {
    CollisionShape shape;
    Obstacle obstacle;
  };
  /// Axis-aligned bounds of an obstacle at t = 0 [m].
  struct Bounds {
    Eigen::Vector3d lower_W, upper_W;
  };
  std::vector<Entry> entries_;
  std::vector<Bounds> bounds_;  // one per entry, side by side: most queries read nothing else
  double speed_ = 0.0;          // of the fastest obstacle
};

}  // namespace halfstep
