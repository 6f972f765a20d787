#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "smoothing/margins/margin.h"
#include "wpg/motion/posture.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// How far a sole may seem below the floor [m]. Its height is exactly 0 while it stands and at
/// least 0 in the air as long as no overlap exceeds its natural bound; SetOverlap grants an
/// overlap 1e-9 s beyond it, which takes up to (15/8)·height/rise·1e-9 s off: 7e-9 m for a step of
/// half a metre within an eighth of a second.
inline constexpr double kSoleRounding = 1e-8;

/// Whether a body is rigid with a foot. Its lowest point is the sole's, or higher: LoadRobot
/// refuses others.
inline bool IsOnFoot(const RobotBody& body) { return body.link == 5; }

/// Heights above the floor z = 0 of a robot's bodies, as the family `ground` counts them: the
/// lowest point of a body that is not on a foot. A body on a foot may touch the floor: it has no
/// limit, +∞, unless its sole is below the floor. Const and thread-safe.
class BodyHeights {
 public:
  /// `robot` is borrowed and must outlive this.
  explicit BodyHeights(const RobotModel& robot);

  /// Bodies of the legs that are not on a foot; those on a foot; indices of RobotModel::bodies.
  const std::vector<int>& of_legs() const { return of_legs_; }
  const std::vector<int>& on_feet() const { return on_feet_; }
  /// The lowest body of the waist, which keeps its height while walking; none: +∞.
  const Margin& of_waist() const { return of_waist_; }

  /// The lowest point of a body of a leg, in W [m]; and a height that is no more than its, found
  /// with less work.
  Eigen::Vector3d LowestPoint(int body, const Posture& posture) const;
  double LowestPossible(int body, const Posture& posture) const;

  /// The least margin of all bodies [m]. Bodies whose height is `enough` or more are not told
  /// apart: they may read less than they have, not less than `enough`. Precondition: links placed.
  Margin Least(const Posture& posture, const WalkState& x,
               double enough = std::numeric_limits<double>::infinity()) const;
  /// The margin of a body on a foot, from the walk's quantities.
  double OnFoot(int body, const WalkState& x) const;

 private:
  const RobotBody& body(int b) const { return robot_.bodies[static_cast<size_t>(b)]; }

  const RobotModel& robot_;
  std::vector<int> of_legs_, on_feet_;
  Margin of_waist_;
};

}  // namespace halfstep
