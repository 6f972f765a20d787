#pragma once

#include <Eigen/Core>

#include "experiments/survey/found_legs.h"

namespace halfstep {

/// The axis of the frame, either way, that a unit `direction` is within `angle` [rad] of, else the
/// direction itself.
Eigen::Vector3d Snapped(const Eigen::Vector3d& direction, double angle);

/// The rotation R_LinkB of the waist frame in the frame of the waist's link: z from the feet to the
/// hips, y from the right hip to the left one, with all joints at zero. A direction that is within
/// a degree of an axis of the link is that axis.
Eigen::Matrix3d FindWaistRotation(const UrdfTree& urdf, const FoundLegs& legs);

}  // namespace halfstep
