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
    replayed.result = replay::Play(simulation, motion, task.options);
    replay::CompareMassModel(robot, tree, motion, &replayed.result);
    stayed_up = stayed_up && replayed.result.stayed_up;
    if (command.push && replayed.result.stayed_up) {
      ProgressBar bar("pushes of " + replayed.method, !screen);
      replayed.pushes = replay::FindPushLimits(
          simulation, motion, task.options, {}, push_at[i],
          [&bar](double done) { bar.Update(done); }, interrupt.token());
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
  app->add_flag("--out", command->out,
                "write METHOD/replay.csv (episode: replay.csv) into the folder");
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  app->add_flag("--json", command->json, "print JSON");
  // CLI11 writes into `engine` while it parses, so it must live as long as the action.
  return [command, engine] { return Replay(*command); };
}

}  // namespace halfstep
