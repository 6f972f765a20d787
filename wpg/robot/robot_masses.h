#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

namespace halfstep {

/// Mass, centre of mass and inertia of a rigid body, in the frame that its owner names.
struct BodyMass {
  double mass = 0.0;                                  ///< [kg] ≥ 0
  Eigen::Vector3d com{0, 0, 0};                       ///< centre of mass [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about `com`, the frame's axes [kg m²]
};

/// Masses of a robot's bodies as walking moves them. A link that hangs on a leg's link by joints
/// outside the leg counts with that, every other link with the waist, in the standing posture.
struct RobotMasses {
  BodyMass waist;                                ///< in the waist frame B
  std::array<std::array<BodyMass, 6>, 2> links;  ///< of the legs by Index(Side), in link frames
  /// Why the masses cannot be those of a robot, so that nothing is said about its dynamics; "" when
  /// they can.
  std::string fault = "no masses were read";

  bool known() const { return fault.empty(); }  ///< whether dynamics of the whole robot can be told
};

}  // namespace halfstep
