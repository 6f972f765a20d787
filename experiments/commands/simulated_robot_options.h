#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <vector>

#include "experiments/replay/simulated_robot.h"

namespace halfstep {

/// The options of a simulated robot.
struct SimulatedRobotOptions {
  std::vector<CLI::Option*> all;  ///< as they were declared
  std::function<void()> finish;   ///< reads what was parsed into the robot; throws InputError
};
/// Declares them. `robot` is borrowed until the command has run.
SimulatedRobotOptions DeclareSimulatedRobot(CLI::App* app, replay::SimulatedRobot* robot);

}  // namespace halfstep
