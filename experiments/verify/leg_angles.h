#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// Where the parts of a leg are, seen from the waist B.
struct LegPlace {
  std::array<Eigen::Vector3d, 6> axes, points;  ///< unit vectors; a point of each axis [m]
  std::array<Eigen::Isometry3d, 7> X_BLink;     ///< the six links and, last, the sole
};
/// For joint angles q [rad].
LegPlace PlaceLegAt(const Leg& leg, const Vector6d& q);

/// Joint angles [rad] that bring a leg's sole to X_BSole in the branch of the standing posture;
/// none where it does not reach. Where the axes of hip or ankle miss each other, those of the leg
/// whose axes meet, followed by Newton's method while its axes move to where they are.
/// Source: wpg/README.md, "Leg inverse kinematics", whose equations are solved here as
/// a cos q + b sin q = c, one after the other.
///
/// Where the angles at a near place of the same motion are known, Newton's method starts from these
/// (`near`, may be null), and they count where its steps begin below 0.05 rad and shrink to less
/// than a quarter each time: then no other posture is as near (Kantorovich), and it is on the same
/// branch. Else they are not used.
std::optional<Vector6d> AnglesOf(const Leg& leg, const Eigen::Isometry3d& X_BSole,
                                 const Vector6d* near = nullptr);

/// The turn and the way, in B, from where a leg's sole is to X_BSole [rad], [m].
Vector6d FromSoleTo(const LegPlace& place, const Eigen::Isometry3d& X_BSole);

}  // namespace halfstep::verify
