#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "planner/collision/separation.h"
#include "planner/scene/scene.h"

namespace halfstep {

/// The obstacles of a scene, prepared for queries about convex bodies at a time t of the walk [s].
/// The margin of an obstacle to a body is their distance with the obstacle at PoseAt(t), less its
/// UncertaintyAt(t) (planner/README.md, "Obstacles that move"). Queries are const and their scratch
/// is the caller's, so one world serves many threads. A pose or a time that is not finite throws
/// std::logic_error.
class CollisionWorld {
 public:
  /// The directions that separated a body from each obstacle in earlier queries. Most neighbouring
  /// instants are decided by them, without a distance query. Use one scratch for each body and
  /// thread.
  struct Scratch {
    std::vector<Eigen::Vector3d> normals_W;  ///< by obstacle; zero: none yet.
  };
  struct Nearest {
    int obstacle = -1;  ///< index into the scene, −1: none within the horizon.
    /// From the obstacle, where it is said to be, to the body.
    Separation separation;
    /// The distance less the obstacle's uncertainty [m]; the horizon when there is none.
    double margin = 0.0;
  };

  /// Precondition: finite obstacle poses (std::logic_error).
  explicit CollisionWorld(const Scene& scene);

  int num_obstacles() const { return static_cast<int>(entries_.size()); }
  /// The margin of an obstacle changes at no more than this speed [m/s] (Obstacle::speed).
  double speed(int obstacle) const { return entries_[static_cast<size_t>(obstacle)].speed; }

  /// The obstacle with the least margin to the body at X_WB at the worst of the times [t −
  /// half_width, t + half_width] as its speed bounds it, among those where that is below `horizon`
  /// [m]. The margin told is that at t.
  Nearest FindNearest(const CollisionShape& body, const Eigen::Isometry3d& X_WB, double t,
                      double horizon, double half_width = 0.0) const;

  /// Whether the margin of every obstacle to the body at X_WB is at least `clearance` [m] at all
  /// times of [t − half_width, t + half_width]. A lower bound decides, so true is proved.
  bool Clears(const CollisionShape& body, const Eigen::Isometry3d& X_WB, double t, double clearance,
              Scratch* scratch, double half_width = 0.0) const;

 private:
  struct Entry {
    CollisionShape shape;
    Obstacle obstacle;
    double speed = 0.0;   // of its margin, at most [m/s]
    double radius = 0.0;  // about its frame's origin [m]; 0 when it has no waypoints
    bool still = true;    // no motion and no uncertainty
  };
  // What an obstacle's margin at the worst of the times t ± half_width is below the distance from
  // its pose at t at most: its uncertainty, and its way in that time [m].
  static double Taken(const Entry& entry, double t, double half_width) {
    if (entry.still) return 0.0;
    return entry.obstacle.UncertaintyAt(t) + entry.speed * half_width;
  }
  // How far from its bounds an obstacle is at t at most [m].
  static double Moved(const Entry& entry, double t) {
    if (entry.still) return 0.0;
    return entry.obstacle.motion.DisplacementAt(entry.obstacle.X_WO, entry.radius, t);
  }

  /// Axis-aligned bounds of an obstacle at t = 0 [m].
  struct Bounds {
    Eigen::Vector3d lower_W, upper_W;
  };
  std::vector<Entry> entries_;
  std::vector<Bounds> bounds_;  // one per entry, side by side: most queries read nothing else
  bool still_ = true;           // all entries are
};

}  // namespace halfstep
