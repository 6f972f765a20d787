#pragma once

#include <Eigen/Core>

#include "experiments/verify/walk_plan.h"
#include "experiments/verify/zmp_shift.h"

namespace halfstep::verify {

/// Where the numbers of a walk stand in WalkNumbers: CoM x, y and ZMP x, y [m], the waist's yaw
/// [rad], of each sole x, y, z [m] and yaw [rad], and how far the waist is above where it stands on
/// z = 0 [m].
enum WalkNumber : int {
  kComX = 0,
  kZmpX = 2,
  kWaistYaw = 4,
  kLeftX = 5,
  kRightX = 9,
  kWaistZ = 13,
  kNumWalkNumbers = 14
};
using WalkNumbers = Eigen::Matrix<double, kNumWalkNumbers, 1>;  ///< in W
/// The first number of a sole by Index(Side).
constexpr int SoleX(int side) { return side == 0 ? kLeftX : kRightX; }

/// The numbers of a walk at an instant and their time derivatives [1/s], [1/s²].
struct WalkInstant {
  WalkNumbers value = WalkNumbers::Zero();   ///< [m], [rad]
  WalkNumbers first = WalkNumbers::Zero();   ///< [m/s], [rad/s]
  WalkNumbers second = WalkNumbers::Zero();  ///< [m/s²], [rad/s²]
};

/// A half-step as a function of its local time τ [s], in W: at rest before 0 and after T.
/// Source: [Perrin2011] §III; wpg/README.md, "Half-step".
class HalfStepMotion {
 public:
  /// ω of the pendulum [1/s]. Precondition: a form in its ranges, ω·T ∈ [0.5, 60]
  /// (std::logic_error).
  HalfStepMotion(const PlacedHalfStep& placed, double omega);

  const HalfStep& half_step() const { return half_step_; }  ///< of which it is
  const WalkNumbers& start() const { return start_; }       ///< where it begins
  /// Adds f(τ) − f(0).
  void AddAt(double tau, WalkInstant* at) const;
  /// Bounds of |c̈ x|, |c̈ y| and of the same of the ZMP over [from, to], added up [m/s²].
  Eigen::Vector2d SecondBounds(double from, double to) const;

  /// Height of the place where the swing foot stands before it (up) or after it (down), in W [m].
  double FootstepHeight() const { return footstep_height_; }
  double duration() const { return half_step_.duration; }                ///< T [s]
  double t1() const { return duration() * (1 - form().zmp_shift) / 2; }  ///< when the ZMP shifts
  double t2() const { return duration() * (1 + form().zmp_shift) / 2; }  ///< until then
  /// When the foot moves horizontally [s].
  double foot_begin() const { return half_step_.up ? t2() + form().foot_delay * duration() : 0; }
  double foot_end() const {  ///< until then [s]
    return half_step_.up ? duration() : t1() - form().foot_delay * duration();
  }

 private:
  const FormColumns& form() const { return half_step_.form; }
  Jet FootAt(double sigma) const;
  Jet HeightAt(double sigma) const;
  Jet RiseAt(double sigma) const;

  HalfStep half_step_;
  ZmpShift shift_;
  double footstep_height_;
  WalkNumbers start_, delta_;  // f(0), f(T) − f(0)
};

}  // namespace halfstep::verify
