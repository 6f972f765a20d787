#include "experiments/replay/simulated_robot.h"

#include <algorithm>
#include <utility>

#include "experiments/replay/run_replay.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"

namespace halfstep::replay {
namespace {

bool IsControlled(const SimulatedRobot& simulated) {
  return simulated.controller.value_or("none") != "none";
}

// Throws InputError for what no controller can do with.
void CheckController(const SimulatedRobot& simulated, const RobotModel& robot) {
  std::vector<std::string> names = simulated.controllers.names();
  names.insert(names.begin(), "none");
  const std::string name = simulated.controller.value_or("none");
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw InputError({"--controller: there is no " + name + " (valid: " + Joined(names) + ")"});
  }
  if (!IsControlled(simulated)) {
    if (simulated.sensor_delay)
      throw InputError({"--sensor-delay: without a --controller it says nothing"});
    if (simulated.sensor_seed)
      throw InputError({"--sensor-seed: without a --controller it says nothing"});
    return;
  }
  constexpr double kMostDelay = 1.0;
  if (const double s = simulated.sensor_delay.value_or(0.0); !(s >= 0.0 && s <= kMostDelay)) {
    throw InputError({"--sensor-delay " + ShortestText(s) + ": no delay (valid: 0 … 1 s)"});
  }
  if (!robot.masses.known()) {
    throw InputError({"--controller " + name + ": of " + robot.name + ", " + robot.masses.fault});
  }
}

// Throws InputError.
FloorRelief ReliefOf(const std::string& text, const SimulatedGround& ground) {
  const FloorRelief relief = ParseRelief("--floor", text);
  if (ground.uneven() && (relief.plates != 0.0 || relief.curb != 0.0)) {
    throw InputError({"--floor " + Quote(text) +
                      ": plates and curbs are of the flat floor, and the scene's ground has levels "
                      "(valid: slope=A, which turns all of the ground)"});
  }
  return relief;
}

// What moves the robot in place of the plan. Precondition: IsControlled(simulated).
ControlSetup ControlOf(const SimulatedRobot& simulated) {
  ControlSetup control{
      .make = [controllers = simulated.controllers, name = *simulated.controller](
                  const control::ControlledRobot& robot) { return controllers.Make(name, robot); },
      .sensors = {}};
  control.sensors.delay = simulated.sensor_delay.value_or(control.sensors.delay);
  control.sensors.seed = simulated.sensor_seed;
  return control;
}

}  // namespace

ReplaySetup SimulatedRobot::SetupOf(WholeRobot whole, const SimulatedObstacles& world) const {
  ReplaySetup setup = replay::SetupOf(std::move(whole), world, robot);
  if (floor) setup.relief = ReliefOf(*floor, world.ground);
  CheckController(*this, setup.robot.model);
  if (IsControlled(*this)) setup.control = ControlOf(*this);
  return setup;
}

}  // namespace halfstep::replay
