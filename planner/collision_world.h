#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "planner/scene.h"
#include "planner/separation.h"

namespace halfstep {

/// The obstacles of a scene, prepared for queries of posed convex bodies. Const queries; scratch is
/// the caller's, so one world serves many threads.
class CollisionWorld {
 public:
  /// Separating directions of earlier queries, one per obstacle: neighbouring instants are decided
  /// by them without a distance query. One scratch per body and thread.
  struct Scratch {
    std::vector<Eigen::Vector3d> normals_W;
  };
  struct Nearest {
    int obstacle = -1;      ///< index into the scene, −1: none within the horizon.
    Separation separation;  ///< distance = horizon when none.
  };

  explicit CollisionWorld(const Scene& scene);

  int num_obstacles() const { return static_cast<int>(entries_.size()); }

  /// Nearest obstacle to the body at X_WB among those nearer than `horizon` [m].
  Nearest FindNearest(const CollisionShape& body, const Eigen::Isometry3d& X_WB,
                      double horizon) const;

  /// Whether every obstacle is at least `clearance` [m] away (by the sound lower bound).
  bool Clears(const CollisionShape& body, const Eigen::Isometry3d& X_WB, double clearance,
              Scratch* scratch) const;

 private:
  struct Entry {
    CollisionShape shape;
    Eigen::Isometry3d X_WO;
    Eigen::Vector3d lower_W, upper_W;  // axis-aligned bounds
    Eigen::Vector3d center_W;
    double radius;
  };
  std::vector<Entry> entries_;
};

}  // namespace halfstep
