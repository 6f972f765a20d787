#pragma once

#include "wpg/motion/vector_ball.h"

namespace halfstep {

/// What a rigid body does over an interval of time [m − h, m + h], up to third derivatives: balls
/// that hold everything of the exact body for all t there, with what is computed at m for centres
/// of all but the third. In the axes of W. `p` is a point that is fixed in the body.
struct RigidMotion {
  VectorBall turn, turn1, turn2;  ///< ω [rad/s], ω̇, ω̈
  VectorBall p, p1, p2, p3;       ///< place of the point [m], and its derivatives
  double turned = 0.0;  ///< the body is turned by at most this from where it is computed at m [rad]
  double turn_off = 0.0;  ///< what of that rounding does [rad]
  double arm_off = 0.0;   ///< how far the way from one point to another may be off at m [m]

  /// Sets `turned` from `turn`, h = `half_width` [s].
  void BoundTurned(double half_width) { turned = half_width * turn.most() + turn_off; }

  /// A vector that is fixed in the body and is `at_m` in W at m.
  VectorBall Carried(const Eigen::Vector3d& at_m) const {
    return {at_m, at_m.norm() * std::min(turned, 2.0)};
  }
  /// The same motion with another point of the body, which is `at_m` from `p` at m.
  RigidMotion At(const Eigen::Vector3d& at_m) const {
    VectorBall d = Carried(at_m);
    d.radius += arm_off;
    const VectorBall d1 = Cross(turn, d), d2 = Cross(turn, d1);
    RigidMotion motion = *this;
    motion.p += d;
    motion.p1 += d1;
    motion.p2 += Cross(turn1, d) + d2;
    motion.p3 +=
        Cross(turn2, d) + 2.0 * Cross(turn1, d1) + Cross(turn, Cross(turn1, d)) + Cross(turn, d2);
    return motion;
  }
};

/// A joint's speed [rad/s] and its two derivatives over an interval.
struct JointRates {
  Range speed, acceleration, third;  ///< q̇, q̈, q⃛
};

/// The motion of a body that turns by a joint about an axis through `base`'s point that is fixed in
/// both and has the direction `axis` at m. Its point is that of `base`.
inline RigidMotion Turned(const RigidMotion& base, const Eigen::Vector3d& axis,
                          const JointRates& joint, double half_width) {
  const VectorBall a = base.Carried(axis), a1 = Cross(base.turn, a);
  const VectorBall a2 = Cross(base.turn1, a) + Cross(base.turn, a1);
  RigidMotion body = base;
  body.turn += joint.speed * a;
  body.turn1 += joint.acceleration * a + joint.speed * a1;
  body.turn2 += joint.third * a + 2.0 * (joint.acceleration * a1) + joint.speed * a2;
  body.BoundTurned(half_width);
  return body;
}

}  // namespace halfstep
