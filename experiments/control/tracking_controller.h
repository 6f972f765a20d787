#pragma once

#include <Eigen/Geometry>
#include <array>
#include <memory>

#include "wpg/robot/robot_model.h"

namespace halfstep::control {

/// What the floor does to a sole, as a force sensor at its centre has it.
struct SoleLoad {
  double force = 0.0;            ///< along the sole's z [N]; 0: it carries nothing
  Eigen::Vector2d centre{0, 0};  ///< of pressure, in the sole's frame [m]; 0 without force
};

/// What a robot measures of itself at an instant. Arrays are indexed by Index(Side).
struct MeasuredState {
  double t = 0.0;                     ///< when it was measured, by the time of the walk [s]
  std::array<Vector6d, 2> q, speeds;  ///< of the legs' joints [rad], [rad/s]
  Eigen::Matrix3d R_WB = Eigen::Matrix3d::Identity();  ///< IMU: the waist's orientation in W
  Eigen::Vector3d turn_B{0, 0, 0};  ///< IMU: the waist's angular velocity, in B [rad/s]
  std::array<SoleLoad, 2> loads;    ///< of both soles
};

/// What is planned for an instant. Arrays are indexed by Index(Side).
struct PlannedState {
  double t = 0.0;                     ///< [s]
  std::array<Vector6d, 2> q, speeds;  ///< of the legs' joints [rad], [rad/s]
  /// What the motors then give [N m]; 0 where masses are not known or a leg is stretched.
  std::array<Vector6d, 2> torques;
  /// What the feet do to their ankles: moments about the origins of the frames of the legs' last
  /// joints, in W [N m]; 0 where torques are.
  std::array<Eigen::Vector3d, 2> ankle_moments;
  Eigen::Isometry3d X_WB;                    ///< of the waist; upright
  std::array<Eigen::Isometry3d, 2> X_WSole;  ///< of the soles' centres; upright
  std::array<bool, 2> stands{};              ///< whether a sole carries
  Eigen::Vector3d com{0, 0, 0};              ///< of the whole robot, by its masses, in W [m]
  Eigen::Vector3d com_velocity{0, 0, 0};     ///< [m/s]
  /// Of the whole robot, not of the walk's model, in W, in the plane z = zmp_height [m].
  Eigen::Vector2d zmp{0, 0};
  double zmp_height = 0.0;  ///< of the sole that stands, or halfway between two, in W [m]
  /// How far the ZMP goes aside for each metre of that plane's height: f_t/f_z of the force.
  Eigen::Vector2d tilt{0, 0};
  /// Where each sole stands or will stand next, after its last landing where it stands: z in W [m].
  std::array<double, 2> levels{};
  double force = 0.0;  ///< that the floor gives, along z of W [N]
};

/// What the servos shall do, by Index(Side). Between two commands they follow the cubic that has
/// these angles and speeds at its ends.
struct JointCommand {
  std::array<Vector6d, 2> q;       ///< [rad]
  std::array<Vector6d, 2> speeds;  ///< [rad/s]
};

/// A controller that makes a robot follow its plan: measured state in, joint commands out, once
/// every kControlPeriod. It is an object with a state; a clone goes on independently, and the same
/// calls give the same commands.
class TrackingController {
 public:
  virtual ~TrackingController() = default;
  /// `then`: what was planned for measured.t, which is some time ago (SensorOptions::delay).
  /// `next`: what is planned for the end of the period that begins now, at which the command is
  /// reached.
  virtual JointCommand Command(const MeasuredState& measured, const PlannedState& then,
                               const PlannedState& next) = 0;
  virtual std::unique_ptr<TrackingController> Clone() const = 0;  ///< in the same state
};

/// Between two commands [s].
inline constexpr double kControlPeriod = 0.005;

}  // namespace halfstep::control
