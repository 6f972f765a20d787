#pragma once

#include <Eigen/Core>
#include <array>

#include "wpg/geometry/pose2.h"
#include "wpg/geometry/side.h"
#include "wpg/geometry/support_polygon.h"
#include "wpg/motion/robot_dynamics.h"
#include "wpg/motion/standing_heights.h"
#include "wpg/motion/walk_state.h"
#include "wpg/motion/zmp_drift.h"
#include "wpg/nth.h"

namespace halfstep {

/// Two soles at different heights that carry a robot, and the shadows that they cast along the
/// floor's force in the plane halfway between them. The line of the robot's ZMPs meets the soles'
/// hull in space where the ZMP of that plane is inside the hull of the shadows. Source:
/// wpg/README.md, "Soles at different heights".
class SoleShadows {
 public:
  /// Of soles of full length and width `sole_size` [m] where a walk's quantities x have them.
  /// Precondition: the dynamics have a ZMP.
  SoleShadows(const WalkState& x, const StandingHeights& heights, const Eigen::Vector2d& sole_size,
              const RobotDynamics& dynamics);

  const StandingHeights& heights() const { return heights_; }  ///< of the soles
  const Eigen::Vector2d& tilt() const { return tilt_; }        ///< RobotDynamics::Tilt
  const Eigen::Vector2d& zmp() const { return zmp_; }          ///< in the plane halfway, in W [m]
  /// A shadow's place in that plane.
  const Pose2& place(Side side) const { return Nth(places_, Index(side)); }
  const SupportPolygon& hull() const { return hull_; }  ///< of both shadows
  /// The sole of whose shadow a corner of the hull is a corner.
  Side SoleOf(const Eigen::Vector2d& corner) const {
    return SoleWithCorner(places_, sole_size_, corner);
  }

  /// How far the line may be moved aside, any way, before it misses the soles' hull [m]; negative
  /// outside, as SupportPolygon::Margin is.
  double Margin() const { return hull_.Margin(zmp_); }
  /// The least Margin() of all times of an interval of which this is the midpoint, `drift` being of
  /// the plane halfway, while the soles rest; −∞ where it may be negative. Source:
  /// smoothing/README.md, "The robot's ZMP between instants".
  double LeastOver(const ZmpDrift& drift) const;

 private:
  StandingHeights heights_;
  Eigen::Vector2d tilt_, zmp_, sole_size_;
  std::array<Pose2, 2> places_;
  SupportPolygon hull_;
};

}  // namespace halfstep
