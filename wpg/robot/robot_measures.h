#pragma once

#include <string>

namespace halfstep {

struct RobotModel;

/// What the sizes of a robot's half-steps go by.
struct RobotMeasures {
  /// ℓ: from the hip over the knee to the ankle, and from there down to the sole, knee and ankle
  /// stretched [m].
  double leg_length = 0.0;
  double standing_width = 0.0;  ///< w: distance of the sole centres in the standing posture [m].
  /// q̇: least speed limit of a leg's joint [rad/s], each over its share of what a knee turns in a
  /// half-step: 1 about y, 0.3 about x, 0.1 about z.
  double slowest_joint = 0.0;
  /// The farthest aside of the support sole, and there the highest, to which either swing foot goes
  /// within the joints' limits while the CoM is above the support sole [m]. At most 8/7 w; and half
  /// of ℓ and RobotModel::largest_lift.
  double aside = 0.0, lift = 0.0;  ///< both [m]
  double support_point = 0.0;      ///< RobotModel::support_point [m]
  double sole_width = 0.0;         ///< the shorter side of a sole [m]
};

/// RobotMeasures::leg_length of the left leg [m].
double LegLengthOf(const RobotModel& robot);

/// What legs, joint limits and speed limits of the model give.
RobotMeasures MeasuresOf(const RobotModel& robot);

/// The same of a robot file, without its bodies, so meshes are not read. Throws InputError for what
/// LoadRobot() refuses of waist and legs.
RobotMeasures MeasureRobot(const std::string& yaml_path);

}  // namespace halfstep
