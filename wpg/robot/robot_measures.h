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
  double slowest_joint = 0.0;   ///< q̇: least speed limit of a leg's joint [rad/s].
};

RobotMeasures MeasuresOf(const RobotModel& robot);

/// The same of a robot file, without its bodies, so meshes are not read. Throws InputError for what
/// LoadRobot() refuses of waist and legs.
RobotMeasures MeasureRobot(const std::string& yaml_path);

}  // namespace halfstep
