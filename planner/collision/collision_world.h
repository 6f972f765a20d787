#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "planner/collision/separation.h"
#include "planner/scene/scene.h"
#include "wpg/geometry/bounds_tree.h"
#include "wpg/nth.h"

namespace halfstep {

/// The obstacles of a scene, and behind them the solids of its ground, prepared for queries about
/// convex bodies at a time t of the walk [s]. The margin of an obstacle to a body is their distance
/// with the obstacle at PoseAt(t), less its UncertaintyAt(t) (planner/README.md, "Obstacles that
/// move"). Solids rest, and a query may leave out the low ones. Queries are const and their scratch
/// is the caller's, so one world serves many threads. A pose or a time that is not finite throws
/// std::logic_error.
class CollisionWorld {
 public:
  /// The directions that separated a body from each obstacle in earlier queries. Most neighbouring
  /// instants are decided by them, without a distance query. Use one scratch for each body and
  /// thread.
  struct Scratch {
    std::map<int, Eigen::Vector3d> normals_W;  ///< by obstacle, of those that came near.
    std::vector<int> near;  ///< indices of obstacles that the last query looked at
  };
  /// The obstacle that is nearest to a body.
  struct Nearest {
    int obstacle = -1;  ///< as Scene::NameOf counts, −1: none within the cap.
    /// From the obstacle, where it is said to be, to the body.
    Separation separation;
    /// The distance less the obstacle's uncertainty [m]; the cap when there is none.
    double margin = 0.0;
  };

  /// As `above` of queries: no solid is left out [m].
  static constexpr double kAllSolids = -std::numeric_limits<double>::infinity();

  /// Precondition: finite obstacle poses and solids (std::logic_error). Obstacles without waypoints
  /// lie in a tree, and what a query needs of one is built when a body first comes near it.
  explicit CollisionWorld(const Scene& scene);

  /// Those of the scene, and the solids of its ground.
  int num_obstacles() const { return static_cast<int>(entries_.size()); }
  bool has_solids() const { return has_solids_; }  ///< whether there are any of these
  /// The margin of an obstacle changes at no more than this speed [m/s] (Obstacle::speed).
  double speed(int obstacle) const { return Nth(entries_, obstacle).speed; }

  /// The obstacle with the least margin to the body at X_WB at the worst of the times [t −
  /// half_width, t + half_width] as its speed bounds it, among those where that is below `cap`
  /// [m]. The margin told is that at t. Solids whose top is at `above` [m] or lower are left out.
  Nearest FindNearest(const CollisionShape& body, const Eigen::Isometry3d& X_WB, double t,
                      double cap, double half_width = 0.0, double above = kAllSolids) const;

  /// Whether the margin of every obstacle to the body at X_WB is at least `clearance` [m] at all
  /// times of [t − half_width, t + half_width]. A lower bound decides, so true is proved. Solids
  /// whose top is at `above` [m] or lower are left out.
  bool Clears(const CollisionShape& body, const Eigen::Isometry3d& X_WB, double t, double clearance,
              Scratch* scratch, double half_width = 0.0, double above = kAllSolids) const;

 private:
  struct Entry {
    Eigen::Isometry3d X_WO;
    ObstacleMotion motion;
    double speed = 0.0;            // of its margin, at most [m/s]
    double radius = 0.0;           // about its frame's origin [m]; 0 when it has no waypoints
    bool still = true;             // no motion and no uncertainty
    Eigen::AlignedBox3d bounds_W;  // at t = 0 [m]
    // Of a solid of the ground [m]; an obstacle has no top, and is never left out.
    double top = std::numeric_limits<double>::infinity();
  };
  struct Shapes;
  // What bounds the uncertainties of all obstacles in the tree.
  struct Uncertainty {
    double error = 0.0, speed = 0.0, horizon = 0.0;  // the largest
    double first = 0.0, last = 0.0;                  // time of measurement [s]
    bool any = false;
    void Add(const ObstacleMotion& motion);
    double Most(double t, double half_width) const;
  };

  // What an obstacle's margin at the worst of the times t ± half_width is below the distance from
  // its pose at t at most: its uncertainty, and its way in that time [m].
  static double Taken(const Entry& entry, double t, double half_width) {
    if (entry.still) return 0.0;
    return entry.motion.UncertaintyAt(t) + entry.speed * half_width;
  }
  // How far from its bounds an obstacle is at t at most [m].
  static double Moved(const Entry& entry, double t) {
    if (entry.still) return 0.0;
    return entry.motion.DisplacementAt(entry.X_WO, entry.radius, t);
  }
  const CollisionShape& ShapeOf(int obstacle) const;

  void Add(const Obstacle& obstacle, double top, std::vector<Eigen::AlignedBox3d>* boxes);

  std::vector<Entry> entries_;
  bool has_solids_ = false;
  std::shared_ptr<Shapes> shapes_;
  BoundsTree tree_;              // of obstacles without waypoints
  std::vector<int> in_tree_;     // which they are
  std::vector<int> on_the_way_;  // the others
  Uncertainty uncertainty_;
};

}  // namespace halfstep
