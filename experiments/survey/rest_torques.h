#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// What the weakest leg joint has to give while the robot rests on one foot, the other one lifted:
/// that whose torque is most beyond its limit, as a share of it.
struct RestTorque {
  std::string joint;    ///< its name
  double needed = 0.0;  ///< either way [N m]
  double limit = 0.0;   ///< what it gives [N m]; `needed` may be less
  /// How much further towards the lifted foot than the ZMP the CoM would have to be, so that the
  /// joint held, by what the LIPM accelerates the CoM then [m]; 0: it holds at rest; ∞: that would
  /// make it worse.
  double inside = 0.0;
};

/// Looks at both feet, lifted as the six steps that a robot takes by default lift them. None where
/// masses or torques are not known, or a leg does not reach. A guess for sentences: between these
/// states nothing is said.
std::optional<RestTorque> WeakestAtRest(const RobotModel& robot);

/// What a joint that does not hold at rest would need, as lines for the user; none where it holds.
/// `robot_file`: where limits stand.
std::vector<std::string> RestText(const RestTorque& rest, double stance,
                                  const std::string& robot_file);

}  // namespace halfstep
