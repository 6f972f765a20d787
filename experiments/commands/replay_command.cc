#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "experiments/commands/command_line.h"
#include "experiments/commands/command_mistake.h"
#include "experiments/commands/commands.h"
#include "experiments/config/experiment.h"
#include "experiments/config/folder_name.h"
#include "experiments/replay/episode_folder.h"
#include "experiments/replay/mujoco_model.h"
#include "experiments/replay/replay_screen.h"
#include "experiments/replay/simulated_obstacles.h"
#include "experiments/run/interrupt.h"
#include "experiments/run/progress_bar.h"
#include "experiments/tables/certificate_files.h"
#include "experiments/tables/run_folder.h"
#include "experiments/tables/run_record.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/suggestion.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

// Instants of pushes within a walk.
std::vector<double> Instants(const ReplayCommand& command, double duration) {
  if (command.push_at.empty()) return {0.25 * duration, 0.5 * duration, 0.75 * duration};
  for (const double at : command.push_at) {
    if (at >= 0 && at <= duration) continue;
    throw InputError({"--push-at " + ShortestText(at) + ": is not within the walk (valid: 0 … " +
                      ShortestText(duration) + ")"});
  }
  return command.push_at;
}

/// A walk as the servos follow it.
struct NamedMotion {
  std::string method;
  std::string table;  ///< its replay.csv in the folder, without the extension
  replay::ReferenceMotion motion;
};

/// All that is simulated.
struct Task {
  WholeRobot robot;
  replay::SimulatedObstacles world;
  std::vector<NamedMotion> motions;
  replay::PlayOptions options = {};
};

Task RunTask(const ReplayCommand& command) {
  const std::vector<std::string> methods = MethodsOfRun(command.run, command.method);
  const ExperimentConfig config =
      LoadConfig((fs::path(command.run) / "config.yaml").string(), {}, command.tools);
  Task task{.robot = LoadWholeRobot(RobotPath(config).string()), .world = {}, .motions = {}};
  if (const auto scene = ScenePath(config)) {
    task.world = replay::ObstaclesOf(LoadScene(scene->string()));
  }
  for (const std::string& method : methods) {
    const fs::path path = fs::path(command.run) / MethodFolder(method) / "trajectory.csv";
    task.motions.push_back({method, MethodFolder(method) + "/replay",
                            replay::ReferenceMotion(ReadTrajectory(path, task.robot.model))});
  }
  return task;
}

Task EpisodeTask(const ReplayCommand& command) {
  if (command.method) {
    throw InputError({"--method: " + command.run + " is an episode, which has one walk"});
  }
  replay::RecordedEpisode episode = replay::ReadEpisode(command.run, command.tools);
  Task task{.robot = std::move(episode.robot),
            .world = replay::ObstaclesOf(episode.truth),
            .motions = {}};
  task.motions.push_back({"episode", "replay", std::move(episode.motion)});
  task.options.drift_window = episode.config.live.horizon;
  return task;
}

// Instants of the pushes of each motion.
std::vector<std::vector<double>> AllInstants(const ReplayCommand& command, const Task& task) {
  if (!command.push_at.empty() && !command.push) {
    throw InputError({"--push-at: without --push it says nothing"});
  }
  std::vector<std::vector<double>> all;
  for (const NamedMotion& one : task.motions) all.push_back(Instants(command, one.motion.end()));
  return all;
}

std::vector<std::string> NamesOf(const auto& things) {
  std::vector<std::string> names;
  for (const auto& thing : things) names.push_back(thing.name);
  return names;
}

bool IsControlled(const ReplayCommand& command) {
  return command.controller.value_or("none") != "none";
}

// Throws InputError for what no controller can do with.
void CheckController(const ReplayCommand& command, const RobotModel& robot) {
  std::vector<std::string> names = command.controllers.names();
  names.insert(names.begin(), "none");
  const std::string name = command.controller.value_or("none");
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw InputError({"--controller: there is no " + name + " (valid: " + Joined(names) + ")"});
  }
  if (!IsControlled(command)) {
    if (command.sensor_delay)
      throw InputError({"--sensor-delay: without a --controller it says nothing"});
    if (command.sensor_seed)
      throw InputError({"--sensor-seed: without a --controller it says nothing"});
    return;
  }
  constexpr double kMostDelay = 1.0;
  if (const double s = command.sensor_delay.value_or(0.0); !(s >= 0.0 && s <= kMostDelay)) {
    throw InputError({"--sensor-delay " + ShortestText(s) + ": no delay (valid: 0 … 1 s)"});
  }
  if (!robot.masses.known()) {
    throw InputError({"--controller " + name + ": of " + robot.name + ", " + robot.masses.fault});
  }
}

// What moves the robot along a motion; none: the servos get the plan itself.
std::shared_ptr<const replay::ControlLoop> LoopOf(const ReplayCommand& command,
                                                  const RobotModel& robot, double weight,
                                                  const replay::ReferenceMotion& motion) {
  if (!IsControlled(command)) return nullptr;
  control::SensorOptions sensors;
  sensors.delay = command.sensor_delay.value_or(sensors.delay);
  sensors.seed = command.sensor_seed;
  const std::unique_ptr<control::TrackingController> controller =
      command.controllers.Make(*command.controller, {robot, replay::ModelOptions().stiffness});
  return std::make_shared<replay::ControlLoop>(
      std::make_shared<replay::PlannedStates>(robot, motion), *controller,
      control::Sensors(sensors, weight));
}

void WriteRows(const Task& task, const std::vector<replay::Replayed>& all, const std::string& run) {
  RunFolder folder(run, /*overwrite=*/true);
  folder.CopyOlder();
  for (size_t i = 0; i < all.size(); ++i) {
    WriteCsv(task.motions[i].table, ReplayCsv(all[i].result.rows), &folder);
  }
  folder.Publish();
}

}  // namespace

ExitStatus Replay(const ReplayCommand& command) {
  const Task task = IsEpisode(command.run) ? EpisodeTask(command) : RunTask(command);
  const std::vector<std::vector<double>> push_at = AllInstants(command, task);
  CheckController(command, task.robot.model);
  if (const std::string why = replay::WhyNoSimulation(); !why.empty()) {
    std::cerr << "halfstep: replay: " << why << '\n';
    return kFailed;
  }
  InterruptGuard interrupt;
  const auto& [robot, tree] = task.robot;
  const std::vector<replay::SimulatedObstacle>& obstacles = task.world.obstacles;
  const replay::Simulation simulation(replay::MujocoModel(robot, tree, {}, obstacles), robot,
                                      Nth(tree.urdf.links, tree.waist).name, obstacles);
  const bool screen = !command.quiet && !command.json;
  std::vector<replay::Replayed> all;
  bool stayed_up = true;
  for (size_t i = 0; i < task.motions.size(); ++i) {
    const replay::ReferenceMotion& motion = task.motions[i].motion;
    replay::Replayed& replayed = all.emplace_back();
    replayed.method = task.motions[i].method;
    replayed.duration = motion.end();
    replayed.window = task.options.drift_window;
    replayed.bodies = NamesOf(robot.bodies);
    replayed.obstacles = NamesOf(obstacles);
    replayed.controller = command.controller;
    replay::PlayOptions options = task.options;
    options.control = LoopOf(command, robot, simulation.weight(), motion);
    replayed.result = replay::Play(simulation, motion, options);
    replay::CompareMassModel(robot, tree, motion, &replayed.result);
    stayed_up = stayed_up && replayed.result.stayed_up;
    if (command.push && replayed.result.stayed_up) {
      ProgressBar bar("pushes of " + replayed.method, !screen);
      replayed.pushes = replay::FindPushLimits(
          simulation, motion, options, {}, push_at[i], [&bar](double done) { bar.Update(done); },
          interrupt.token());
    }
    if (interrupt.requested()) return kInterrupted;
    if (screen) std::cout << replay::ReplayText(replayed);
  }
  if (command.out) WriteRows(task, all, command.run);
  if (command.json) {
    std::cout << replay::ReplayJson(command.run, task.world.notes, all);
  } else if (screen) {
    for (const std::string& note : task.world.notes) std::cout << note << '\n';
    std::cout << '\n' << replay::kReplayDisclaimer << '\n';
  }
  return stayed_up ? kSuccess : kFailed;
}

CommandAction DeclareReplay(CLI::App* app, const Toolbox& tools) {
  const auto command = std::make_shared<ReplayCommand>();
  command->tools = tools;
  const auto engine = std::make_shared<std::string>("mujoco");
  app->add_option("RUN", command->run, "folder of a run or of an episode")->required();
  app->add_option("--engine", *engine, "mujoco")->check(OneOf({"mujoco"}));
  app->add_option("--method", command->method, "only this one (default: all)");
  app->add_flag("--push", command->push, "find the largest push that each walk survives");
  app->add_option("--push-at", command->push_at, "instants of the push [s]");
  app->add_option(
      "--controller", command->controller,
      "what moves the robot: none (servos get the plan itself), dcm; tells tracking errors");
  app->add_option("--sensor-delay", command->sensor_delay,
                  "what is measured arrives so late [s] (default: 0.005)");
  app->add_option("--sensor-seed", command->sensor_seed,
                  "draws noise of sensors (default: no noise)");
  app->add_flag("--out", command->out,
                "write METHOD/replay.csv (episode: replay.csv) into the folder");
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  app->add_flag("--json", command->json, "print JSON");
  // CLI11 writes into `engine` while it parses, so it must live as long as the action.
  return [command, engine] { return Replay(*command); };
}

}  // namespace halfstep
