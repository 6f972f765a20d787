#pragma once

#include <Eigen/Core>
#include <array>

#include "wpg/geometry/pose2.h"
#include "wpg/geometry/side.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// How the feet share what the floor gives the robot. A foot that stands alone has all of it. Where
/// both stand, the right one has the share λ = d_L/(d_L + d_R) of moment and force, d_L and d_R the
/// distances of the robot's ZMP from the soles' rectangles, and the left one has the rest; a couple
/// beside it puts each foot's own ZMP as far, and that way, from its sole's centre as the other's.
/// All is continuous in the ZMP, and at lift-off and landing wherever the ZMP is inside the sole
/// that stays. Source: wpg/README.md, "What each foot carries"; [Kajita2010].
class FootLoads {
 public:
  /// `support` stands alone.
  static FootLoads OneFoot(Side support);
  /// Soles of full length and width `sole_size` [m], and the robot's ZMP, all in W [m].
  static FootLoads BothFeet(const Pose2& X_WL, const Pose2& X_WR, const Eigen::Vector2d& sole_size,
                            const Eigen::Vector2d& zmp);

  /// A foot's share of the force, ∈ [0, 1].
  double share(Side side) const { return side == Side::kRight ? right_ : 1.0 - right_; }
  /// From the left sole's centre to the right one's [m]; zero where one foot stands alone.
  const Eigen::Vector2d& between() const { return between_; }

  /// The floor's wrench on a foot when that on the robot is `contact`, both about one point.
  Vector6d On(Side side, const Vector6d& contact) const;
  /// Its derivative when `contact` changes by `contact_slope` and the ZMP by `zmp_slope`, while the
  /// soles rest.
  Vector6d SlopeOn(Side side, const Vector6d& contact, const Vector6d& contact_slope,
                   const Eigen::Vector2d& zmp_slope) const;
  /// How much the shares differ at most from these while the ZMP is within `moved` [m] of here.
  double ShareDrift(double moved) const;

 private:
  double right_ = 0.0;                 // λ
  Eigen::Vector2d right_slope_{0, 0};  // ∂λ/∂ZMP [1/m]
  Eigen::Vector2d between_{0, 0};
  std::array<double, 2> distances_{};  // of the ZMP from the soles, negative inside; both feet only
  bool both_ = false;
};

}  // namespace halfstep
