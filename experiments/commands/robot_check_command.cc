#include <iostream>
#include <optional>

#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/run/interrupt.h"
#include "experiments/run/progress_bar.h"
#include "experiments/survey/robot_check.h"
#include "experiments/survey/robot_check_screen.h"
#include "wpg/files/input_error.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

ExitStatus CheckRobotFile(const RobotCheckCommand& command) {
  ExperimentConfig config;
  config.robot = command.robot;
  const std::filesystem::path path = RobotPath(config);
  if (path.extension() != ".yaml") {
    throw InputError({command.robot +
                      ": is no robot file (valid: one in .yaml, or a shipped robot's name; "
                      "`halfstep robot URDF` makes one of a URDF)"});
  }
  InterruptGuard interrupt;
  const RobotModel robot = LoadRobot(path.string());
  if (!command.quiet) TellWarnings(robot);
  std::optional<ProgressBar> bar(std::in_place, robot.name, command.quiet);
  const RobotCheck check =
      CheckRobot(std::filesystem::absolute(path).lexically_normal().string(), robot,
                 {.progress = [&bar](const std::string&, double done) { bar->Update(done); },
                  .stop = interrupt.token()});
  bar.reset();
  if (interrupt.token().stop_requested()) {
    std::cerr << "halfstep: robot --check: stopped before its end\n";
    return kInterrupted;
  }
  std::cout << (command.json ? RobotCheckJson(robot, check) : RobotCheckScreen(robot, check));
  return kSuccess;
}

}  // namespace halfstep
