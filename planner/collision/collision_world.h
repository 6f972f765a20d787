#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "planner/collision/separation.h"
#include "planner/scene/scene.h"

namespace halfstep {

/// The obstacles of a scene, prepared for queries of posed convex bodies. Const queries; scratch is
/// the caller's, so one world serves many threads. A pose that is not finite is a std::logic_error.
class CollisionWorld {
 public:
  /// Separating directions of earlier queries, one per obstacle: neighbouring instants are decided
  /// by them without a distance query. One scratch per body and thread.
  struct Scratch {
    std::vector<Eigen::Vector3d> normals_W;  ///< zero: none yet.
  };
  struct Nearest {
    int obstacle = -1;      ///< index into the scene, −1: none within the horizon.
    Separation separation;  ///< from the obstacle to the body; distance = horizon when none.
  };

  /// Precondition: finite obstacle poses (std::logic_error).
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
  };
  /// Axis-aligned bounds of an obstacle [m].
  struct Bounds {
    Eigen::Vector3d lower_W, upper_W;
  };
  std::vector<Entry> entries_;
  std::vector<Bounds> bounds_;  // one per entry, side by side: most queries read nothing else
};

}  // namespace halfstep
