#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/commands/command_line.h"
#include "experiments/config/experiment.h"
#include "experiments/config/scaled_defaults.h"
#include "experiments/run/exit_status.h"
#include "experiments/survey/starter_config.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"
#include "wpg/files/whole_file.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

struct InitCommand {
  std::string name;
  StarterConfig config{.robot_file = "hrp2"};
  std::vector<double> goal;    // none, or x and y
  bool on_stairs = false;      // --stairs, with
  std::vector<double> stairs;  // none, or its first numbers: rise, run, treads
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

void CheckIsNew(const fs::path& file, bool overwrite) {
  if (fs::exists(file) && !overwrite) {
    throw InputError({file.string() + ": is there already (--overwrite replaces it)"});
  }
}

// A flight of the numbers that are given. Without a rise: three quarters of the highest that the
// robot climbs, or that one where the lower one is not certified.
Flight FlightOf(const std::vector<double>& numbers, const RobotModel& robot,
                const ExperimentConfig& config) {
  const auto given = [&](size_t i, double usual) {
    return i < numbers.size() ? numbers[i] : usual;
  };
  Flight flight{.rise = given(0, 0.0),
                .run = given(1, 0.001 * std::round(1000.0 * UsualRun(robot))),
                .treads = static_cast<int>(given(2, 3.0))};
  if (!numbers.empty()) return flight;
  const auto highest = HighestStairs(flight.run, robot, config, [] { return true; });
  if (!highest) {
    throw InputError(
        {"init: --stairs: of the rises that were tried this robot climbs none at "
         "treads of " +
         ShortestText(flight.run) + " m; name a rise, and a search looks for a walk"});
  }
  flight.rise = 0.001 * std::floor(750.0 * highest->flight.rise);
  return FormFor(flight, robot, config, [] { return true; }) ? flight : highest->flight;
}

// Adds a flight to the config, and returns the text of its scene.
std::string AddStairs(const std::vector<double>& numbers, const RobotModel& robot,
                      StarterConfig* starter) {
  ExperimentConfig config;
  ScaleDefaults(MeasuresOf(robot), &config);
  const Flight flight = FlightOf(numbers, robot, config);
  const std::optional<HalfStepConfig> form = FormFor(flight, robot, config, [] { return true; });
  starter->stairs = {flight, form.value_or(config.half_step)};
  if (!form) starter->why_search = "climbs these stairs by none of the half-steps that were tried";
  return StairsSceneText(flight);
}

// A rise, a run and a whole number of treads.
std::string StairsMistake(const std::vector<double>& numbers) {
  constexpr std::array<const char*, 3> kNames = {"RISE", "RUN", "COUNT"};
  constexpr std::array<double, 3> kLeast = {0.001, 0.02, 1.0}, kMost = {1.0, 2.0, 50.0};
  for (size_t i = 0; i < numbers.size(); ++i) {
    const bool whole = i < 2 || numbers[i] == std::floor(numbers[i]);
    if (numbers[i] >= kLeast.at(i) && numbers[i] <= kMost.at(i) && whole) continue;
    return std::string(kNames.at(i)) + Formatted(": %.6g", numbers[i]) +
           " (valid: " + (i == 2 ? "whole, " : "") + "from " + ShortestText(kLeast.at(i)) + " to " +
           ShortestText(kMost.at(i)) + ")";
  }
  return "";
}

ExitStatus Init(InitCommand command) {
  const fs::path file = FileOf(command.name);
  fs::path scene_file = file;
  scene_file.replace_filename(file.stem().string() + "_scene.yaml");
  CheckIsNew(file, command.overwrite);
  if (const std::string mistake = StairsMistake(command.stairs); !mistake.empty()) {
    throw InputError({"init: --stairs: " + mistake});
  }
  if (command.on_stairs) CheckIsNew(scene_file, command.overwrite);
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
  if (command.on_stairs) {
    const std::string scene = AddStairs(command.stairs, place.robot, &starter);
    starter.scene = scene_file.filename().string();
    WriteWhole(scene_file, {scene});
    std::cout << "written: " << scene_file.string() << '\n';
  }
  WriteWhole(file, {StarterConfigText(place.robot, starter)});
  std::cout << "written: " << file.string() << "\nnext:    halfstep run " << file.string() << '\n';
  return kSuccess;
}

}  // namespace

CommandAction DeclareInit(CLI::App* app, const Toolbox&) {
  const auto command = std::make_shared<InitCommand>();
  app->add_option("NAME", command->name, "of the config; NAME.yaml is written")->required();
  app->add_option("--robot", command->config.robot_file, "name or file of a robot (default: hrp2)");
  CLI::Option* const scene =
      app->add_option("--scene", command->config.scene, "name or file of a scene (default: none)");
  CLI::Option* const goal =
      app->add_option("--goal", command->goal, "X Y: where to go [m] (default: six steps ahead)")
          ->expected(2)
          ->check(CLI::Range(-1000.0, 1000.0));
  CLI::Option* const stairs =
      app->add_option("--stairs", command->stairs,
                      "RISE RUN COUNT: up stairs, a scene beside the config [m] (default of each: "
                      "what the robot climbs, a tread for its soles, 3)")
          ->expected(0, 3)
          ->excludes(scene)
          ->excludes(goal);
  app->add_flag("--overwrite", command->overwrite, "replace older files");
  return [command, stairs] {
    command->on_stairs = stairs->count() > 0;
    if (stairs->results() == std::vector<std::string>{""}) command->stairs.clear();
    return Init(*command);
  };
}

}  // namespace halfstep
