#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "wpg/geometry/pose2.h"
#include "wpg/geometry/side.h"
#include "wpg/motion/standing_heights.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// How the feet share what the floor gives the robot. A foot that stands alone has all of it. Where
/// both stand, the right one has the share λ = d_L/(d_L + d_R) of moment and force, d_L and d_R the
/// distances of the robot's ZMP from the soles' rectangles, and the left one has the rest; a couple
/// beside it puts each foot's own ZMP as far, and that way, from its sole's centre as the other's.
/// All is continuous in the ZMP, and at lift-off and landing wherever the ZMP is inside the sole
/// that stays. Where the soles stand at different heights, each foot's distance and ZMP are in the
/// plane of its own sole. Source: wpg/README.md, "What each foot carries"; [Kajita2010].
class FootLoads {
 public:
  /// `support` stands alone.
  static FootLoads OneFoot(Side support);
  /// Soles of full length and width `sole_size` [m], and the robot's ZMP, all in W [m].
  static FootLoads BothFeet(const Pose2& X_WL, const Pose2& X_WR, const Eigen::Vector2d& sole_size,
                            const Eigen::Vector2d& zmp);
  /// The same of two soles at different heights, at their places in the walk's quantities x; zmps:
  /// the robot's ZMP in the planes of the left and of the right sole. None where both are inside of
  /// their soles: nothing says then which foot carries.
  static std::optional<FootLoads> OnLevels(const WalkState& x, const StandingHeights& heights,
                                           const Eigen::Vector2d& sole_size,
                                           const std::array<Eigen::Vector2d, 2>& zmps);

  /// A foot's share of the force, ∈ [0, 1].
  double share(Side side) const { return side == Side::kRight ? right_ : 1.0 - right_; }
  bool both() const { return both_; }  ///< whether both feet stand
  /// From the left sole's centre to the right one's, seen from above [m]; zero where one foot
  /// stands alone.
  const Eigen::Vector2d& between() const { return between_; }
  double rise() const { return rise_; }  ///< how much the right sole is higher [m]

  /// The floor's wrench on a foot when that on the robot is `contact`, both about one point.
  Vector6d On(Side side, const Vector6d& contact) const;
  /// Its derivative when `contact` changes by `contact_slope` and the ZMP in the plane of the left
  /// sole by `zmp_slope`, while the soles rest.
  Vector6d SlopeOn(Side side, const Vector6d& contact, const Vector6d& contact_slope,
                   const Eigen::Vector2d& zmp_slope) const;
  /// How much the shares differ at most from these while the ZMP is within `moved` [m] of here, in
  /// the plane of each sole; ∞ where it may come to be inside of two soles at different heights.
  double ShareDrift(double moved) const;

 private:
  static FootLoads Shared(const Pose2& X_WL, const Pose2& X_WR, const Eigen::Vector2d& sole_size,
                          const std::array<Eigen::Vector2d, 2>& zmps, double rise);

  double right_ = 0.0;                 // λ
  Eigen::Vector2d right_slope_{0, 0};  // ∂λ/∂ZMP [1/m], of both planes
  Eigen::Vector2d tilt_slope_{0, 0};   // ∂λ/∂tilt, the ZMP in the plane of the left sole held
  Eigen::Vector2d between_{0, 0};
  double rise_ = 0.0;
  std::array<double, 2> distances_{};  // of the ZMP from the soles, negative inside; both feet only
  bool both_ = false;
};

}  // namespace halfstep
