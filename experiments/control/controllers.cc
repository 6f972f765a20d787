#include "experiments/control/controllers.h"

#include <utility>

#include "experiments/control/dcm_controller.h"
#include "wpg/check.h"

namespace halfstep::control {

Controllers Controllers::Standard() {
  Controllers controllers;
  controllers.Add("dcm", [](const ControlledRobot& robot) {
    const DcmOptions known{
        .stiffness = robot.servos.stiffness, .damping = robot.servos.damping, .ankle = robot.ankle};
    return std::make_unique<DcmController>(robot.model, known);
  });
  return controllers;
}

void Controllers::Add(const std::string& name, MakeController make) {
  const bool is_new = name != "none" && makers_.emplace(name, std::move(make)).second;
  HALFSTEP_CHECK(is_new, "a second controller " << name);
}

std::vector<std::string> Controllers::names() const {
  std::vector<std::string> names;
  for (const auto& [name, make] : makers_) names.push_back(name);
  return names;
}

std::unique_ptr<TrackingController> Controllers::Make(const std::string& name,
                                                      const ControlledRobot& robot) const {
  return makers_.at(name)(robot);
}

}  // namespace halfstep::control
