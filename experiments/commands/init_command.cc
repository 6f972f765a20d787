#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/commands/command_line.h"
#include "experiments/config/experiment.h"
#include "experiments/run/exit_status.h"
#include "experiments/survey/starter_config.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/files/whole_file.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

struct InitCommand {
  std::string name;
  StarterConfig config{.robot_file = "hrp2"};
  std::vector<double> goal;  // none, or x and y
  bool overwrite = false;
};

// NAME.yaml, in the working directory unless NAME is a path.
fs::path FileOf(const std::string& name) {
  fs::path file = name;
  if (file.extension() != ".yaml") file += ".yaml";
  if (const std::string mistake = NameMistake(file.stem().string()); !mistake.empty()) {
    throw InputError({"init: NAME: " + mistake});
  }
  return file;
}

ExitStatus Init(InitCommand command) {
  const fs::path file = FileOf(command.name);
  if (fs::exists(file) && !command.overwrite) {
    throw InputError({file.string() + ": is there already (--overwrite replaces it)"});
  }
  ExperimentConfig config;  // its paths are relative to the working directory
  config.robot = command.config.robot_file;
  config.scene = command.config.scene;
  const Place place = LoadPlace(config);
  TellWarnings(place.robot, place.scene);
  const ExperimentConfig moved = MovedTo(fs::absolute(file).parent_path(), config);
  StarterConfig& starter = command.config;  // what was said as a whole path stays one
  if (!fs::path(starter.robot_file).is_absolute()) starter.robot_file = moved.robot;
  if (!fs::path(starter.scene).is_absolute()) starter.scene = moved.scene;
  if (!command.goal.empty()) starter.goal = {command.goal[0], command.goal[1]};
  WriteWhole(file, {StarterConfigText(place.robot, starter)});
  std::cout << "written: " << file.string() << "\nnext:    halfstep run " << file.string() << '\n';
  return kSuccess;
}

}  // namespace

CommandAction DeclareInit(CLI::App* app, const Toolbox&) {
  const auto command = std::make_shared<InitCommand>();
  app->add_option("NAME", command->name, "of the config; NAME.yaml is written")->required();
  app->add_option("--robot", command->config.robot_file, "name or file of a robot (default: hrp2)");
  app->add_option("--scene", command->config.scene, "name or file of a scene (default: none)");
  app->add_option("--goal", command->goal, "X Y: where to go [m] (default: six steps ahead)")
      ->expected(2)
      ->check(CLI::Range(-1000.0, 1000.0));
  app->add_flag("--overwrite", command->overwrite, "replace an older file");
  return [command] { return Init(*command); };
}

}  // namespace halfstep
