#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "wpg/robot/leg_ik.h"
#include "wpg/robot/leg_rounding.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The anchors of a leg's links: points of their joints' axes, about which they turn. Where the
/// axes meet, that is the hip for links 0–2 and the ankle for links 3–5 and the sole, at rest in
/// waist and sole. Elsewhere an anchor turns with the link before.
class LegAnchors {
 public:
  /// Of one leg; nothing is borrowed.
  explicit LegAnchors(const Leg& leg);

  /// Whether a link's anchor is the hip and not the ankle.
  static bool OnHip(int link) { return link <= 2; }
  /// The ankle in B, the hip in B, the ankle in the sole frame [m].
  Eigen::Vector3d Ankle(const LegFrames& frames) const { return frames.X_BLink[6] * ankle_S_; }
  const Eigen::Vector3d& hip_B() const { return hip_B_; }      ///< the hip, in B [m]
  const Eigen::Vector3d& ankle_S() const { return ankle_S_; }  ///< the ankle, in the sole frame [m]
  /// How far the turns of each link carry a body, seen from waist (links 0–2) or sole (3–5): from
  /// its own link's anchor to its farthest point, and for the links between it and waist or sole
  /// from their anchor to the next one [m]. 0 for the others.
  std::array<double, 6> Levers(const RobotBody& body) const;

 private:
  Eigen::Vector3d hip_B_, ankle_S_;
  std::array<Eigen::Vector3d, 6> anchor_L_;  // in the link's frame
  std::array<double, 6> to_next_;  // from its anchor to that of the link that it carries [m]
};

/// What the motion demands of a leg: suprema over [m − h, m + h], with w = hip − ankle.
struct LegDemand {
  double half_square = 0.0;       ///< |d²(½‖w‖²)/dt²| [m²/s²]
  double horizontal = 0.0;        ///< horizontal part of ẅ, seen from the sole [m/s²]
  double vertical = 0.0;          ///< vertical part of ẅ [m/s²]
  double yaw_rate = 0.0;          ///< of the sole, seen from the waist [rad/s]
  double yaw_acceleration = 0.0;  ///< [rad/s²]
};

/// Suprema of a link's angular velocity and acceleration.
struct TurnBound {
  double speed = 0.0;         ///< ‖ω‖ [rad/s]
  double acceleration = 0.0;  ///< ‖ω̇‖ [rad/s²]
};

/// Bounds of joint motion for all t in [m − h, m + h].
struct JointBounds {
  Vector6d speed;         ///< sup |q̇_i| [rad/s]
  Vector6d acceleration;  ///< sup |q̈_i| [rad/s²]
  /// How fast the links turn: 0–2 seen from the waist, 3–5 seen from the sole.
  std::array<TurnBound, 6> turns;
};

/// Joint bounds from what is known at m: the frames (waist and sole upright), the joint speeds
/// [rad/s] and the sole's yaw rate seen from the waist [rad/s]. The knee is bounded by the
/// hip–ankle distance, then the ankle, then the hip. The proof is a bootstrap: assumed bounds of
/// the speeds hold where they imply smaller ones. Returns none when it fails, because h =
/// `half_width` [s] is too long or the leg too nearly stretched. Where there is a bound, the leg
/// reaches and stays in its branch. `off` says how far frames and speeds may be off by rounding.
/// Source: smoothing/README.md, "Motion bounds" and "Rounding".
std::optional<JointBounds> BoundJoints(const LegAnchors& anchors, const LegFrames& frames,
                                       const Vector6d& speeds, double yaw_rate,
                                       const LegDemand& demand, double half_width,
                                       const LegRounding& off = {});

}  // namespace halfstep
