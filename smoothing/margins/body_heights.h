#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "smoothing/margins/margin.h"
#include "wpg/motion/posture.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// How far below the floor a sole may seem to be [m]. Its height is exactly 0 while it stands, and
/// at least 0 in the air as long as no overlap exceeds its natural bound. SetOverlap lets an
/// overlap exceed it by kOverlapTolerance, which lowers the sole by up to
/// (15/8)·height/rise·kOverlapTolerance: 7.5e-12 m for a step of half a metre within an eighth of a
/// second.
inline constexpr double kSoleRounding = 1e-8;

/// Whether a body is rigid with a foot. LoadRobot refuses a robot with such a body more than 1e-6 m
/// below the sole.
inline bool IsOnFoot(const RobotBody& body) { return body.link == 5; }

/// Heights of a robot's bodies above the floor of a Ground [m], as the family `ground` counts them.
/// A body that is not on a foot has the height of its lowest point. A body on a foot may touch the
/// floor, so it has no limit and reads +∞, unless its sole is below the floor by more than
/// kSoleRounding. Const and thread-safe.
class BodyHeights {
 public:
  /// `robot` is borrowed and must outlive this; `floor` is Ground::Floor [m].
  BodyHeights(const RobotModel& robot, double floor);

  /// Bodies of the legs that are not on a foot, and bodies on a foot, as indices of
  /// RobotModel::bodies.
  const std::vector<int>& of_legs() const { return of_legs_; }
  const std::vector<int>& on_feet() const { return on_feet_; }  ///< bodies on a foot, by index
  /// The margin of the waist's lowest body where the waist is as high as on the floor, kWaistZ = 0;
  /// +∞ when there is none.
  const Margin& of_waist() const { return of_waist_; }

  /// z of the floor in W [m].
  double floor() const { return floor_; }
  /// The lowest point of a body of a leg, in W [m].
  Eigen::Vector3d LowestPoint(int body, const Posture& posture) const;
  /// A lower bound of that point's height above the floor [m], found with less work.
  double LowestPossible(int body, const Posture& posture) const;

  /// The least margin of all bodies [m]. Bodies that are at `enough` [m] or higher may be left out,
  /// so only a result below `enough` is sure to be the least. Precondition: the links are placed.
  Margin Least(const Posture& posture, const WalkState& x,
               double enough = std::numeric_limits<double>::infinity()) const;
  /// The margin of a body on a foot [m], from the walk's quantities.
  double OnFoot(int body, const WalkState& x) const;

 private:
  const RobotBody& body(int b) const { return Nth(robot_.bodies, b); }

  const RobotModel& robot_;
  double floor_;
  std::vector<int> of_legs_, on_feet_;
  Margin of_waist_;
};

}  // namespace halfstep
