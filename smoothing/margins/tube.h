#pragma once

namespace halfstep {

/// How far a motion may be from the planned one at every instant, and still keep what a certificate
/// covers of it. A turn is about any axis, so that of a foot holds its yaw and its tilt. 0
/// everywhere: the planned motion alone. Source: smoothing/README.md, "Tubes".
struct Tube {
  double foot = 0.0;         ///< of each sole's centre, height included [m]
  double foot_turn = 0.0;    ///< of each sole [rad]
  double waist = 0.0;        ///< of the origin of the waist's frame [m]
  double waist_turn = 0.0;   ///< of the waist [rad]
  double joint = 0.0;        ///< of each angle of the legs' joints [rad]
  double joint_speed = 0.0;  ///< of each of their speeds [rad/s]
  double zmp = 0.0;          ///< of the whole robot's ZMP on the floor [m]

  friend bool operator==(const Tube&, const Tube&) = default;
};

}  // namespace halfstep
