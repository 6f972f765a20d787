#include "experiments/commands/simulated_robot_options.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

// "K,D" of an option.
std::vector<double> SpringOf(const std::string& option, const std::string& text) {
  std::vector<double> spring;
  const size_t comma = std::min(text.find(','), text.size());
  for (const std::string& part :
       {text.substr(0, comma), text.substr(std::min(comma + 1, text.size()))}) {
    const NumberText number = ParseNumber(part);
    if (number.kind == NumberText::Kind::kNumber) spring.push_back(number.value);
  }
  if (spring.empty()) spring = {0.0};
  const std::string mistake = MistakeInSpring(spring);
  if (!mistake.empty()) throw InputError({option + " " + Quote(text) + ": " + mistake});
  return spring;
}

}  // namespace

SimulatedRobotOptions DeclareSimulatedRobot(CLI::App* app, replay::SimulatedRobot* robot) {
  // CLI11 writes into these while it parses, so they must live as long as the action.
  struct Texts {
    std::optional<std::string> servos, ankle;
  };
  const auto texts = std::make_shared<Texts>();
  SimulatedRobotOptions options;
  options.all = {
      app->add_option(
          "--servos", texts->servos,
          "K,D of the servos [N m/rad, N m s/rad] (default: as the robot's size has them)"),
      app->add_option("--ankle", texts->ankle,
                      "K,D of a passive bush above each foot (default: there is none)"),
      app->add_flag("--torque-limits", robot->robot.torque_limits,
                    "servos give no more than the robot's efforts"),
      app->add_option("--floor", robot->floor,
                      "unknown to the plan: plates=H [m], curb=H [m], slope=A [deg], or several "
                      "with commas"),
      app->add_option(
          "--controller", robot->controller,
          "what moves the robot: none (servos get the plan itself), dcm, in episodes client "
          "(with --serve); tells tracking errors"),
      app->add_option("--sensor-delay", robot->sensor_delay,
                      "what is measured arrives so late [s] (default: 0.005)"),
      app->add_option("--sensor-seed", robot->sensor_seed,
                      "draws noise of sensors (default: no noise)")};
  options.finish = [robot, texts] {
    if (texts->servos) robot->robot.servos = SpringOf("--servos", *texts->servos);
    if (texts->ankle) robot->robot.ankle = SpringOf("--ankle", *texts->ankle);
  };
  return options;
}

}  // namespace halfstep
