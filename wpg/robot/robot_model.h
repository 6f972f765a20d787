#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "wpg/files/input_file.h"
#include "wpg/geometry/convex_body.h"
#include "wpg/geometry/side.h"
#include "wpg/robot/robot_masses.h"

namespace halfstep {

/// Six joints of a leg, or a spatial vector.
using Vector6d = Eigen::Matrix<double, 6, 1>;
/// A Jacobian or an inertia (6×6).
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// One revolute leg joint. Axis and point are given in the waist frame B at the zero posture q = 0.
struct LegJoint {
  std::string name;         ///< as in the URDF.
  Eigen::Vector3d axis_B;   ///< unit vector.
  Eigen::Vector3d point_B;  ///< a point on the axis [m].
  double lower = 0.0;       ///< [rad]
  double upper = 0.0;       ///< [rad], lower < upper.
  double max_speed = 0.0;   ///< [rad/s] > 0.
  /// Torque that its motor gives, either way [N m] > 0; ∞: not known.
  double max_torque = std::numeric_limits<double>::infinity();
  /// Acceleration that it is allowed, either way [rad/s²] > 0; ∞: the robot file states none, and
  /// none is assumed.
  double max_acceleration = std::numeric_limits<double>::infinity();
  Eigen::Isometry3d X_BLink;  ///< frame of the link that it moves, at q = 0.
};

/// Each two-fold choice of the closed-form leg inverse kinematics, 0 or 1.
struct LegBranch {
  int knee = 0;   ///< the knee bends forward or backward
  int ankle = 0;  ///< which of two turns of the ankle
  int hip = 0;    ///< which of two turns of the hip
  friend bool operator==(const LegBranch&, const LegBranch&) = default;
};

/// A leg: three hip axes, the knee, two ankle axes, and the sole. Where the hip axes meet in
/// `hip_B` and the ankle axes in `ankle_B` (both at q = 0, in the waist frame), inverse kinematics
/// has a closed form.
struct Leg {
  std::array<LegJoint, 6> joints;  ///< from the waist to the foot.
  Eigen::Vector3d hip_B;           ///< the point nearest to the hip axes at q = 0 [m]
  Eigen::Vector3d ankle_B;         ///< the point nearest to the ankle axes at q = 0 [m]
  Eigen::Isometry3d X_BSole;       ///< sole frame (centre of the sole rectangle, z up) at q = 0.
  LegBranch branch;                ///< of the standing posture, where there is a closed form.
  Vector6d standing_q;             ///< [rad]
  /// Where hip or ankle axes do not meet: the closed-form leg that this one is continued from, with
  /// these axes moved in parallel so that they meet, and the same standing posture. Else empty.
  std::vector<Leg> met;
  /// Then which axes miss each other and by how much, such as "hip axes A and B pass each other at
  /// 50.0 mm".
  std::string offsets;

  /// Whether inverse kinematics is in closed form.
  bool closed_form() const { return met.empty(); }
  /// A point of a joint's axis at q = 0: hip or ankle, or what of the axis is nearest to it.
  Eigen::Vector3d AxisPoint(size_t joint) const;
};

/// A convex collision body, rigid on one link.
struct RobotBody {
  std::string name;  ///< link name, with "#2" … when a link has several bodies.
  int leg = -1;      ///< Index(Side) of the leg that it belongs to, or −1: rigid with the waist.
  int link = -1;     ///< 0 … 5: moved by joints[0 … link] of that leg; −1 on the waist.
  ConvexBody shape = {};  ///< in the frame of its link (leg) or of the waist.
  /// Of the hull of its mesh, when `shape` is a simpler hull around that; else 0.
  int mesh_vertices = 0;
  double excess = 0.0;  ///< no point of `shape` is farther than this from that hull [m].
};

/// Two bodies that move relative to each other and whose distance is not watched.
struct UnwatchedPair {
  int a = -1, b = -1;  ///< indices of RobotModel::bodies, a < b.
  std::string why;     ///< such as "joined by LLEG_JOINT3"; never empty.
};

/// A link that has a mass, and no shape of its own.
struct BareLink {
  std::string name;   ///< as in the URDF
  double mass = 0.0;  ///< [kg] > 0
};

/// A limit of acceleration that is assumed of leg joints of which the robot file states none.
struct AssumedAcceleration {
  double limit = 0.0;  ///< either way [rad/s²] > 0
  int joints = 0;      ///< how many of the twelve have it
};

/// A robot as walking needs it; immutable after loading. Waist frame B: z up when standing.
struct RobotModel {
  std::string name;         ///< in messages and manifests
  std::array<Leg, 2> legs;  ///< indexed by Index(Side).
  /// Whether they are mirror images in the xz plane of B but for rounding (MirrorDifferences).
  bool legs_are_mirrored = true;
  Eigen::Vector2d sole_size;      ///< full length (x) and width (y) of the sole rectangle [m].
  Eigen::Matrix2Xd sole_outline;  ///< of what touches the floor (wpg/robot/sole_outline.h) [m].
  /// Height of B's origin above the floor in the standing posture, kept while walking [m].
  double waist_height = 0.0;
  double com_height = 0.0;  ///< z_c above the floor [m].
  double com_x_B = 0.0;  ///< CoM ahead of B's origin [m]; its y is 0 by the generator's symmetry.
  double mass = 0.0;     ///< [kg]
  RobotMasses masses;    ///< of the waist's and the legs' links
  double standing_width = 0.0;  ///< distance of the sole centres in the standing posture [m].
  /// What is assumed of joint accelerations (AssumeAccelerationLimits); none: nothing.
  std::optional<AssumedAcceleration> assumed_acceleration = {};
  /// How high the swing foot goes at most in half-steps by default [m]; more only on demand.
  double largest_lift = std::numeric_limits<double>::infinity();
  /// Where CoM and ZMP rest on one foot in half-steps by default: along the support sole's y from
  /// its centre, towards the other foot [m].
  double support_point = 0.0;
  std::vector<InputFile> files;  ///< files read: YAML, URDF and meshes, one entry for each reading.
  /// All that may touch something, each on the waist or on a link of a leg.
  std::vector<RobotBody> bodies;
  std::vector<std::array<int, 2>> self_pairs;  ///< pairs of `bodies` that must not touch.
  /// What the URDF has that was repaired or left out, as "file:line:column: …", for the user.
  std::vector<std::string> warnings;
  /// All other pairs of bodies that move relative to each other (wpg/robot/self_pairs.h).
  std::vector<UnwatchedPair> unwatched_pairs;
  /// Links of which nothing is among `bodies`, the heaviest first.
  std::vector<BareLink> bare_links;
};

/// Loads and validates a robot YAML file and the URDF that it names. Format: wpg/README.md,
/// "Robots". Throws InputError (wpg/files/input_error.h) with every complaint as file:line:column.
RobotModel LoadRobot(const std::string& yaml_path);

/// Where the parts of a leg are, seen from the waist B.
struct LegFrames {
  std::array<Eigen::Vector3d, 6> axis_B;     ///< joint axes, unit vectors.
  std::array<Eigen::Vector3d, 6> point_B;    ///< a point on each axis [m].
  std::array<Eigen::Isometry3d, 7> X_BLink;  ///< the six links and, last, the sole.
};
/// The places of the parts for joint angles q [rad].
LegFrames PlaceLeg(const Leg& leg, const Vector6d& q);

/// Poses X_BLink of the links of a leg and, last, of its sole, for joint angles q [rad].
inline std::array<Eigen::Isometry3d, 7> LegForwardKinematics(const Leg& leg, const Vector6d& q) {
  return PlaceLeg(leg, q).X_BLink;
}

}  // namespace halfstep
