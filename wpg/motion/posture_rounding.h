#pragma once

#include <array>

#include "wpg/motion/posture.h"
#include "wpg/motion/walk_state.h"
#include "wpg/robot/leg_rounding.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// LegRounding of both legs, and the same of the waist.
struct PostureRounding {
  double origin = 0.0;              ///< of the waist's origin, in W [m]; no matter what it weighs
  double origin_speed = 0.0;        ///< of its velocity [m/s]
  double waist = 0.0;               ///< of a point of the waist's bodies or its CoM, in W [m]
  double waist_speed = 0.0;         ///< of its velocity [m/s]
  std::array<LegRounding, 2> legs;  ///< by Index(Side)
};

/// A bound of x with |x| ≤ at + K·|x|, the rows of K ≥ 0 adding up to at most `k`; +∞ where one
/// reaches ½.
Vector6d ResolvedRounding(const Vector6d& at, const Vector6d& k);

/// Bounds rounding in postures of one robot after the fact: the computed posture is put together
/// again, and what is missing to the demanded one is what rounding did. Const and thread-safe.
/// Source: smoothing/README.md, "Rounding", 3.
class RoundingOfPostures {
 public:
  /// `robot` is borrowed and must outlive this.
  explicit RoundingOfPostures(const RobotModel& robot);

  /// Of a posture whose links are placed and whose joint speeds are solved, from these quantities,
  /// which are off by at most `walk`: value and first.
  PostureRounding At(const WalkJet& jet, const WalkJet& walk, const Posture& posture) const;

 private:
  // Of a leg: the way along it from B's origin over its axes to the sole, in any posture; how far a
  // point of it or of its bodies may be from any of its axes, and from B's origin [m]. How far the
  // links' frames are from being orthogonal.
  struct Sizes {
    double chain = 0.0, farthest = 0.0, skew = 0.0;
  };
  // Errors of an upright frame: of its origin [m], its velocity [m/s], its yaw and yaw rate.
  struct Upright {
    double place, speed, turn, rate;
  };
  static Upright WaistOf(const RobotModel& robot, const WalkJet& jet, const WalkJet& walk);
  LegRounding OfLeg(Side side, const WalkJet& jet, const WalkJet& walk, const Upright& waist,
                    const Posture& posture) const;

  const RobotModel& robot_;
  std::array<Sizes, 2> legs_;
  double waist_ = 0.0;  // of its bodies' points from its origin [m]
};

}  // namespace halfstep
