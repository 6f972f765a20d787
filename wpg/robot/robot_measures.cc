#include "wpg/robot/robot_measures.h"

#include <algorithm>
#include <limits>

#include "wpg/files/yaml_fields.h"
#include "wpg/robot/robot_fields.h"
#include "wpg/robot/robot_legs.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {
RobotMeasures MeasuresOf(const RobotModel& robot) {
  const Leg& leg = robot.legs[0];
  RobotMeasures measures{.leg_length =
                             StretchedLength(leg) + (leg.X_BSole.inverse() * leg.ankle_B).z(),
                         .standing_width = robot.standing_width,
                         .slowest_joint = std::numeric_limits<double>::infinity()};
  for (const Leg& each : robot.legs) {
    for (const LegJoint& joint : each.joints) {
      measures.slowest_joint = std::min(measures.slowest_joint, joint.max_speed);
    }
  }
  return measures;
}

RobotMeasures MeasureRobot(const std::string& yaml_path) {
  const std::string text = ReadYamlFile(yaml_path);
  return MeasuresOf(BuildRobot(yaml_path, text, ReadRobotFile(yaml_path, text), RobotParts::kLegs));
}

}  // namespace halfstep
