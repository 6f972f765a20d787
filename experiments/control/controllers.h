#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/control/joint_spring.h"
#include "experiments/control/tracking_controller.h"

namespace halfstep::control {

/// What a controller may know of the robot that it is made for.
struct ControlledRobot {
  const RobotModel& model;  ///< borrowed by the controller; its masses are known
  JointSpring servos;       ///< of the legs' joints
  /// Passive bushes between the legs' last joints and the feet, about the soles' x and y.
  std::optional<JointSpring> ankle = {};
};

/// Makes a controller of a robot.
using MakeController =
    std::function<std::unique_ptr<TrackingController>(const ControlledRobot& robot)>;

/// Controllers by their names. A value: what a program adds is in its copy alone.
class Controllers {
 public:
  /// What is built in: `dcm`.
  static Controllers Standard();

  /// Precondition: no controller has the name, and it is not "none".
  void Add(const std::string& name, MakeController make);
  std::vector<std::string> names() const;  ///< in alphabetical order
  /// Precondition: a name of names().
  std::unique_ptr<TrackingController> Make(const std::string& name,
                                           const ControlledRobot& robot) const;

 private:
  std::map<std::string, MakeController> makers_;
};

}  // namespace halfstep::control
