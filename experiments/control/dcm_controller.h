#pragma once

#include <Eigen/Geometry>
#include <limits>

#include "experiments/control/dcm_error.h"
#include "experiments/control/joint_errors.h"
#include "experiments/control/tracking_controller.h"

namespace halfstep::control {

/// What DcmController goes by: what is known of the robot, and times and shares, so that gains go
/// by the robot's size, mass and servos. Measured: experiments/replay.md, "Tracking controllers".
struct DcmOptions {
  /// Of its servos, as its maker states it [N m/rad]; ∞: not known, then nothing is fed forward and
  /// ankles give way as those of stiff servos have to. Too large: they give way too slowly.
  double stiffness = std::numeric_limits<double>::infinity();
  /// Of its servos [N m s/rad]; 0, not known: what is fed forward asks for too much when it
  /// changes.
  double damping = 0.0;
  /// Bushes above the feet; none: there are none, or they are not known.
  std::optional<JointSpring> ankle = {};
  /// k: the DCM's error decays by e^(−kωt) where the soles are wide enough. Below 0 it grows.
  double gain = 3.0;
  double filter = 0.01;  ///< time constant of the DCM's error [s]
  double inset = 0.05;   ///< of the soles, from each edge, where no ZMP is asked for [share of it]
  /// Within which ankles make a sole's moment what was asked for [s]. 0.05: stiff servos sway.
  double ankle_time = 0.15;
  double leak = 0.5;  ///< within which soles become level again, and legs equally long [s]
  /// Of a change of the moments asked for, the share by which ankles turn at once.
  double at_once = 0.5;
  /// Within which the difference of the feet's forces becomes what was asked for [s].
  double force_time = 0.1;
  /// Of how the waist is off its plan, the share by which a foot in the air is held against it.
  double level = 1.0;
  double follow = 0.03;  ///< time constant of that [s]
  /// Joints' errors are integrated until servos are at rest as stiff as this share of stiff ones.
  double stiffen = 0.5;
  double servo_time = 0.025;  ///< of that integral [s]
  /// Speed of the waist for each metre that the ZMP is off [1/s]. 2: larger pushes are survived,
  /// and the ZMP is off five times as far without a push.
  double waist_rate = 0.0;
};

/// Follows a plan as the field's stabilizers do: feedback of the divergent component of motion
/// ξ = c + ċ/ω asks for a ZMP within the soles, the feet share it, ankles and legs give way until
/// the soles' loads are what was asked for. A foot that meets the floor early or late stays there
/// or goes on down. Footsteps and their times are the plan's. Source: [Englsberger2015] §III,
/// [Kajita2010] §III, [Caron2019] §III; experiments/replay.md, "Tracking controllers".
class DcmController final : public TrackingController {
 public:
  /// Borrows `robot`. Precondition: robot.masses.known().
  DcmController(const RobotModel& robot, const DcmOptions& options);

  JointCommand Command(const MeasuredState& measured, const PlannedState& planned,
                       const PlannedState& next) override;
  std::unique_ptr<TrackingController> Clone() const override;

 private:
  // How a foot is commanded off its plan.
  struct FootOffset {
    Eigen::Vector2d tilt{0, 0};     // by the moment that is missing: roll, pitch in its frame [rad]
    Eigen::Vector2d at_once{0, 0};  // by the moment that is asked for beside the plan's [rad]
    Eigen::Vector3d turn{0, 0, 0};  // against the waist's lean, in W [rad]
    Eigen::Vector3d shift{0, 0, 0};  // against where the waist is [m]
    // Of the floor that it met or misses: the sole's height off the plan [m].
    double floor = 0.0;
    // Planned height, above where it is to land, at which it met the ground in this flight; 0: not
    // yet [m].
    double met = 0.0;
    double from = 0.0;     // z of where it stood before its flight, in W [m]
    bool lifted = false;   // in this flight it has been planned clearly above there
    double missing = 0.0;  // for how long it has missed the floor since it should have landed [s]
    bool pressed = true, landed = true;
  };

  // A foot that meets the floor above its plan goes no deeper; one that misses it goes down until
  // it meets it, and as long as it does, it is not on the floor: changes `then`.
  void MeetFloor(const MeasuredState& measured, const PlannedState& next, PlannedState* then);
  void TurnSoles(const MeasuredState& measured, const PlannedState& then,
                 const std::array<SoleLoad, 2>& wanted, const std::array<SoleLoad, 2>& planned);
  void HoldFeet(const EstimatedState& state, const PlannedState& then, const PlannedState& next);
  void ShiftWaist(const MeasuredState& measured, const PlannedState& then,
                  const Eigen::Vector2d& zmp);
  // How far joints shall be from the plan.
  std::array<Vector6d, 2> Bent(const PlannedState& next) const;
  JointCommand Bend(const MeasuredState& measured, const PlannedState& next);

  const RobotModel& robot_;
  DcmOptions options_;
  double leg_stiffness_;   // of its servos [N m/rad]
  double foot_stiffness_;  // moment of a sole on the floor for each radian [N m/rad]
  bool begun_ = false;
  Eigen::Vector2d shift_{0, 0};  // of the waist [m]
  double difference_ = 0.0;      // of the legs' lengths, left less right [m]
  std::array<FootOffset, 2> feet_;
  DcmError dcm_;
  std::array<AnkleBush, 2> planned_bushes_;  // by the plan
  JointErrors errors_;
  std::array<Vector6d, 2> sag_{Vector6d::Zero(), Vector6d::Zero()};  // of the servos, planned [rad]
  std::array<Vector6d, 2> bent_{Vector6d::Zero(), Vector6d::Zero()};   // Bent(), of the last time
  std::array<Vector6d, 2> added_{Vector6d::Zero(), Vector6d::Zero()};  // to the plan, likewise
};

}  // namespace halfstep::control
