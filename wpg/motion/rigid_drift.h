#pragma once

#include <cmath>

namespace halfstep {

/// How much the motion of a rigid body differs, over an interval of time [m − h, m + h], from what
/// it is at m: suprema of the norms of differences in W, from norms at m. "Its point" is fixed in
/// the body. Source: smoothing/README.md, "The robot's ZMP between instants".
struct RigidDrift {
  double speed = 0.0;         ///< ‖ω‖ at m, exact [rad/s]
  double acceleration = 0.0;  ///< ‖ω̇‖ at m, exact [rad/s²]
  double turned = 0.0;        ///< the body's rotation from m, ≤ h·sup‖ω‖ [rad]
  double turn = 0.0;          ///< of ω [rad/s]
  double turn1 = 0.0;         ///< of ω̇ [rad/s²]
  double p = 0.0;             ///< of the point's place [m]
  double p2 = 0.0;            ///< of the point's acceleration [m/s²]

  double fastest() const { return speed + turn; }  ///< sup ‖ω‖
  /// Of the velocity of a vector that is fixed in the body, for each unit of its length.
  double carried1() const { return turn + speed * turned; }

  /// The same with another point of the body, `distance` [m] from this one.
  RigidDrift At(double distance) const {
    RigidDrift drift = *this;
    drift.p += distance * turned;
    drift.p2 += distance * (turn1 + acceleration * turned + turn * fastest() + speed * carried1());
    return drift;
  }
};

/// A joint's speed and acceleration at m, and how much they differ from that over the interval.
struct JointDrift {
  double speed = 0.0, acceleration = 0.0;  ///< absolute values [rad/s], [rad/s²]
  /// How much they differ from that at most [rad/s], [rad/s²].
  double speed_drift = 0.0, acceleration_drift = 0.0;
};

/// The drift of a body that turns by a joint about an axis through `base`'s point that is fixed in
/// both; its own ‖ω‖ and ‖ω̇‖ at m are `speed` and `acceleration`.
inline RigidDrift Turned(const RigidDrift& base, const JointDrift& joint, double speed,
                         double acceleration, double half_width) {
  RigidDrift drift = base;
  drift.speed = speed;
  drift.acceleration = acceleration;
  drift.turn += joint.speed_drift + joint.speed * base.turned;
  drift.turn1 += joint.acceleration_drift + joint.acceleration * base.turned +
                 joint.speed_drift * base.fastest() + joint.speed * base.carried1();
  drift.turned = half_width * drift.fastest();
  return drift;
}

}  // namespace halfstep
