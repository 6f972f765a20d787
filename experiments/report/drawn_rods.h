#pragma once

#include <Eigen/Core>
#include <vector>

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// A rod with round ends between two joints of a robot, for the eye only: nothing that is proved
/// knows it.
struct DrawnRod {
  int leg = -1, link = -1;       ///< what it moves with, as of RobotBody
  Eigen::Vector3d from_B, to_B;  ///< its ends at q = 0, in the waist frame [m]
  double radius = 0.0;           ///< [m] > 0
};

/// The rods of the links of a robot's URDF that have no shape of their own (a neck, a forearm), so
/// that what hangs on them does not float: from each one's joint to those that hang on it, and to
/// it from the joint that it hangs on. The robot's file is read again; none where that fails.
std::vector<DrawnRod> DrawnRods(const RobotModel& robot);

}  // namespace halfstep
