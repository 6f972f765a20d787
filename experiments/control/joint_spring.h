#pragma once

namespace halfstep::control {

/// What turns a joint back to where it shall be.
struct JointSpring {
  double stiffness = 0.0;  ///< [N m/rad]
  double damping = 0.0;    ///< [N m s/rad]
};

}  // namespace halfstep::control
