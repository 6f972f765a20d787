#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/scene/scene.h"
#include "wpg/geometry/bounds_tree.h"
#include "wpg/geometry/foothold.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// How a foot lies to a solid of the ground: its outline from above to the solid's polygon, and its
/// sole's height to the solid's top and bottom. The outline at the sole's height, a flat polygon,
/// is at Distance() from the solid, exactly where that is ≥ 0; below 0 it is in the solid. Where
/// the solid's top is at or below the sole, no point of the foot is nearer than that.
struct SolidGap {
  int solid = -1;       ///< index into Ground::Solids
  double beside = 0.0;  ///< from the outline to the polygon, seen from above; < 0: they overlap [m]
  double above = 0.0;   ///< from the top up, or from the bottom down; < 0: between these [m]

  double Distance() const;  ///< [m]
  /// No less is it after the foot has moved by `moved` [m] seen from above, and by `lifted` up or
  /// down [m].
  double LeastAfter(double moved, double lifted) const {
    return SolidGap{solid, beside - moved, above - lifted}.Distance();
  }
};

/// Distances of a robot's feet from the solids of a scene's ground, as the family `floor` counts
/// them. Const and thread-safe.
class FootSolids {
 public:
  /// Nothing is borrowed but the scene's ground.
  FootSolids(const RobotModel& robot, const Scene& scene);

  bool empty() const { return solids_.empty(); }  ///< whether the ground has none
  /// The largest distance of a point of a foot's outline from the sole frame's origin [m].
  double reach() const { return reach_; }

  /// The solids that a foot whose sole is at X_WF is less than `cap` > 0 [m] from, in the order of
  /// the ground. Replaces `gaps`.
  void Near(const Foothold& X_WF, double cap, std::vector<SolidGap>* gaps) const;

  /// ∂Distance/∂(x, y, z, yaw) of the foot, whose gap at X_WF is `gap` [m/m, m/rad].
  Eigen::Vector4d Gradient(const Foothold& X_WF, const SolidGap& gap) const;

 private:
  struct Solid {
    Eigen::Matrix2Xd polygon;
    double top, bottom;
    Eigen::Vector2d center;  // of a circle around the polygon [m]
    double radius;
  };
  double Beside(const Pose2& X_WF, const Solid& solid) const;

  std::vector<Solid> solids_;
  BoundsTree tree_;
  Eigen::Matrix2Xd outline_;  // FootOutline
  double reach_ = 0.0;
};

}  // namespace halfstep
