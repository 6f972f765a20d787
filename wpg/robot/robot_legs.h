#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "wpg/files/input_error.h"
#include "wpg/robot/robot_model.h"
#include "wpg/robot/urdf_file.h"

namespace halfstep {

/// What a leg needs beside the URDF.
struct LegRequest {
  int waist = -1;  ///< link index of the waist.
  int foot = -1;   ///< link index of the foot.
  /// The sole's pose in the frame of the foot's link.
  Eigen::Isometry3d X_FootSole = Eigen::Isometry3d::Identity();
  std::vector<double> lower;   ///< limits by URDF joint index [rad].
  std::vector<double> upper;   ///< the same of the upper ones [rad]
  std::vector<double> torque;  ///< limits by URDF joint index [N m]; ∞: not known.
  /// Limits by URDF joint index [rad/s²]; ∞: none is stated.
  std::vector<double> acceleration;
  std::vector<double> posture;  ///< standing posture by URDF joint index [rad].
};

/// URDF joint indices of the six joints between waist and foot, from the waist down. Complains, at
/// the place of the foot or the joint, and returns none when these are not six revolute joints
/// (fixed ones are not counted).
std::optional<std::array<int, 6>> FindLegJoints(const UrdfTree& urdf, int waist, int foot,
                                                Complaints* complaints);

/// The stretched length of a leg: hip over knee to ankle [m].
double StretchedLength(const Leg& leg);

/// From the hip over the knee to the ankle, and from there down to the sole, knee and ankle
/// stretched [m].
double LengthOfLeg(const Leg& leg);

/// The leg with the points nearest to its hip and ankle axes, and with the sentence `offsets` where
/// these do not meet; without branch and closed-form neighbour, so that the closed form takes the
/// axes as meeting there: soles are level, but as far off as the axes. Complains and returns none
/// when the leg cannot be moved (see wpg/README.md), or a joint's limits are more than a turn
/// apart.
std::optional<Leg> LegGeometry(const UrdfTree& urdf, const LegRequest& request,
                               const std::array<int, 6>& joints, Complaints* complaints);

/// The same with the branch of the standing posture or the neighbour. Complains and returns none,
/// too, when the standing posture is singular, or too near to that for a proof where there is no
/// closed form.
std::optional<Leg> BuildLeg(const UrdfTree& urdf, const LegRequest& request,
                            const std::array<int, 6>& joints, Complaints* complaints);

/// In what the right leg is not the left one's mirror image in the xz plane of the waist, each with
/// its size, such as "the axis of R by 0.5 deg"; empty when it is. Compared are hip and ankle,
/// joint axes, and the limits of angles, speeds, torques and accelerations, each to `tolerance` [m,
/// rad, rad/s, N m, rad/s²].
std::vector<std::string> MirrorDifferences(const Leg& left, const Leg& right, double tolerance);

}  // namespace halfstep
