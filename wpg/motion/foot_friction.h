#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "wpg/geometry/support_polygon.h"
#include "wpg/motion/contact_rate.h"
#include "wpg/motion/robot_drift.h"
#include "wpg/motion/sole_section.h"
#include "wpg/motion/standing_heights.h"
#include "wpg/motion/zmp_drift.h"

namespace halfstep {

/// The friction coefficient that the soles need so as not to slip or turn, for a pressure of two
/// points of the support polygon, p ± ρ u about the ZMP p: (‖f_t‖ + |n_z|/ρ)/f_z with the floor's
/// tangential force f_t, its push f_z and its yaw moment n_z about p. The direction u is along that
/// edge of the polygon for which ρ is largest. Where two soles stand at different heights, the
/// polygon is their SoleSection. What is passed is borrowed. Source: wpg/README.md, "Friction that
/// is needed".
class FootFriction {
 public:
  /// Of soles in the plane z = `height` [m]. None where the floor does not push, or the ZMP is not
  /// inside.
  static std::optional<FootFriction> Of(const RobotDynamics& dynamics,
                                        const SupportPolygon& polygon, double height = 0.0);
  static std::optional<FootFriction> Of(RobotDynamics&& dynamics, const SupportPolygon& polygon,
                                        double height = 0.0) = delete;
  /// Of two soles at different heights, at their places in the walk's quantities x. None where the
  /// floor does not push, or the line of the ZMPs is not inside of the soles' hull.
  static std::optional<FootFriction> OnLevels(const RobotDynamics& dynamics, const WalkState& x,
                                              const StandingHeights& heights,
                                              const Eigen::Vector2d& sole_size);

  double height() const { return height_; }  ///< z of the polygon's plane [m]
  /// How far the ZMP is inside the polygon [m].
  double inside() const { return polygon_.Margin(zmp_); }
  /// The least friction coefficient at which the sole does not slip.
  double needed() const { return (pull_.norm() + std::abs(turn_) / reach_.distance) / push_; }
  /// Its derivative when dynamics.contact() changes by `contact_slope`, about the same O, while the
  /// polygon rests.
  double Slope(const Vector6d& contact_slope) const { return Gradient().dot(contact_slope); }
  /// Its gradient with respect to dynamics.contact(), while the polygon rests.
  Vector6d Gradient() const;
  /// How much what is needed exactly is more than needed() over an interval at most; ∞: there is no
  /// bound. `zmp` is of the plane of height(), `soles_off` how far rounding may carry the polygon's
  /// edges [m].
  double Drift(const RobotDrift& robot, const ZmpDrift& zmp, double soles_off = 0.0) const;
  /// The same from rates of what the floor gives, about the ZMP in that plane: tighter by far where
  /// the interval is short.
  double Drift(const ContactRate& rate, double soles_off = 0.0) const;

 private:
  // How far the ZMP is inside an edge along u, and the edge's inward normal for each metre along u:
  // of each metre towards the edge, at least around_ counts.
  struct Reach {
    double distance = 0.0;  // [m]
    Eigen::Vector2d normal{0, 0};
  };

  FootFriction(const RobotDynamics& dynamics, const SupportPolygon& polygon,
               const Eigen::Vector2d& zmp, double height);
  // Calls visit(reach) for every edge that is not along `direction`.
  template <typename Visit>
  void ForEachReach(const Eigen::Vector2d& direction, const Visit& visit) const;
  // Whether the ZMP stays inside all edges of the polygon.
  bool StaysInside(const ZmpDrift& zmp, double soles_off) const;
  // By how much corners may stand out of the exact polygon [m].
  double LeftOut() const;
  // How far turn_ may be from that of dynamics.contact() about zmp_ [N m].
  double TurnRounding() const;
  // The ZMP's distance from the polygon's edges along `direction` either way.
  Reach ReachAlong(const Eigen::Vector2d& direction) const;

  const RobotDynamics& dynamics_;
  SupportPolygon polygon_;
  Eigen::Vector2d zmp_, pull_, along_{1, 0};  // along_: u
  double turn_, push_, height_, around_ = 0.0;
  Reach reach_;
};

}  // namespace halfstep
