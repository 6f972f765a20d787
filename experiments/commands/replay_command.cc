#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "experiments/commands/command_line.h"
#include "experiments/commands/command_mistake.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/simulated_robot_options.h"
#include "experiments/config/experiment.h"
#include "experiments/replay/episode_folder.h"
#include "experiments/replay/play_once.h"
#include "experiments/replay/recorded_run.h"
#include "experiments/replay/replay_screen.h"
#include "experiments/replay/seeds_screen.h"
#include "experiments/run/interrupt.h"
#include "experiments/run/progress_bar.h"
#include "experiments/tables/certificate_files.h"
#include "experiments/tables/run_folder.h"
#include "experiments/tables/run_record.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"
#include "wpg/robot/torque_limits.h"

namespace halfstep {
namespace {

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

/// All that is simulated.
struct Task {
  replay::ReplaySetup setup;
  std::vector<std::string> notes;             ///< on what is simulated otherwise than files say
  std::vector<replay::RecordedWalk> motions;  // `folder` of an episode is ""
};

// Throws InputError for what no tube speaks of.
void CheckTube(const ReplayCommand& command) {
  if (!command.suggest_tube) return;
  if (command.push) {
    throw InputError(
        {"--suggest-tube: a walk that --push makes fall is in no tube (valid: without "
         "--push; --seeds pushes as well)"});
  }
  if (command.simulated.floor) {
    throw InputError(
        {"--suggest-tube: a tube is about the floor that is planned (valid: without "
         "--floor)"});
  }
  if (IsEpisode(command.run)) {
    throw InputError({"--suggest-tube: " + command.run + " is an episode, which takes no tube"});
  }
}

Task TaskOf(const ReplayCommand& command, WholeRobot robot,
            const replay::SimulatedObstacles& world) {
  if (command.suggest_tube && world.ground.uneven()) {
    throw InputError(
        {"--suggest-tube: the scene's ground has levels, and tubes know the flat floor only "
         "(valid: a scene without `surfaces`)"});
  }
  Task task{.setup = command.simulated.SetupOf(std::move(robot), world),
            .notes = world.notes,
            .motions = {}};
  task.setup.measures_tube = command.suggest_tube;
  const std::vector<std::string> unknown = JointsOfUnknownTorque(task.setup.robot.model);
  if (command.simulated.robot.torque_limits) {
    task.notes.push_back("Leg joints whose servos have no torque limit: " +
                         (unknown.empty() ? "none." : std::to_string(unknown.size()) + " of 12."));
  }
  return task;
}

Task RunTask(const ReplayCommand& command) {
  replay::RecordedRun run = replay::ReadRun(command.run, command.method, command.tools);
  Task task = TaskOf(command, std::move(run.robot), run.world);
  task.motions = std::move(run.walks);
  return task;
}

Task EpisodeTask(const ReplayCommand& command) {
  if (command.method) {
    throw InputError({"--method: " + command.run + " is an episode, which has one walk"});
  }
  replay::RecordedEpisode episode = replay::ReadEpisode(command.run, command.tools);
  Task task = TaskOf(command, std::move(episode.robot), replay::ObstaclesOf(episode.truth));
  task.motions.push_back({"episode", "", std::move(episode.motion)});
  task.setup.play.drift_window = episode.config.live.horizon;
  return task;
}

// Instants of the pushes of each motion.
std::vector<std::vector<double>> AllInstants(const ReplayCommand& command, const Task& task) {
  if (!command.push_at.empty() && !command.push) {
    throw InputError({"--push-at: without --push it says nothing"});
  }
  if (command.push_directions != ReplayCommand{}.push_directions && !command.push) {
    throw InputError({"--push-directions: without --push it says nothing"});
  }
  std::vector<std::vector<double>> all;
  for (const replay::RecordedWalk& one : task.motions)
    all.push_back(Instants(command, one.motion.end()));
  return all;
}

// Writes one table for each motion into the run.
void WriteTables(const Task& task, const std::string& run, const std::string& name,
                 const std::vector<CsvFile>& tables) {
  RunFolder folder(run, /*overwrite=*/true);
  folder.CopyOlder();
  for (size_t i = 0; i < tables.size(); ++i) {
    WriteCsv(task.motions[i].folder + name, tables[i], &folder);
  }
  folder.Publish();
}

// What is common to both ways to replay: how it is told, and where it is written.
struct Telling {
  const ReplayCommand& command;
  const Task& task;
  InterruptGuard& interrupt;
  bool screen() const { return !command.quiet && !command.json; }

  ExitStatus Finish(const std::string& name, const std::vector<CsvFile>& tables,
                    const std::string& json, bool stayed_up) const {
    if (command.out) WriteTables(task, command.run, name, tables);
    if (command.json) {
      std::cout << json;
    } else if (screen()) {
      for (const std::string& note : task.notes) std::cout << note << '\n';
      std::cout << '\n' << replay::kReplayDisclaimer << '\n';
    }
    return stayed_up ? kSuccess : kFailed;
  }
};

// Each walk once, undisturbed but for the floor, which is that of seed 1.
ExitStatus ReplayOnce(const Telling& telling, const std::vector<std::vector<double>>& push_at) {
  const auto& [command, task, interrupt] = telling;
  std::vector<replay::Replayed> all;
  std::vector<CsvFile> tables;
  bool stayed_up = true;
  const RobotModel& robot = task.setup.robot.model;
  for (size_t i = 0; i < task.motions.size(); ++i) {
    const replay::ReferenceMotion& motion = task.motions[i].motion;
    replay::Replayed& replayed =
        all.emplace_back(replay::PlayOnce(task.setup, task.motions[i].method, motion));
    replayed.controller = command.simulated.controller;
    stayed_up = stayed_up && replayed.result.stayed_up;
    if (command.suggest_tube) replayed.tube = replay::SuggestTube({&replayed.result}, robot);
    if (command.push && replayed.result.stayed_up) {
      const replay::Simulation simulation = replay::RobotOfOnce(task.setup, motion);
      ProgressBar bar("pushes of " + replayed.method, !telling.screen());
      replayed.pushes = replay::FindPushLimits(
          simulation, motion, task.setup.PlayOf(simulation, motion),
          {.directions = command.push_directions}, push_at[i],
          [&bar](double done) { bar.Update(done); }, interrupt.token());
    }
    if (interrupt.requested()) return kInterrupted;
    if (telling.screen()) std::cout << replay::ReplayText(replayed);
    tables.push_back(replay::ReplayCsv(replayed.result.rows));
  }
  return telling.Finish("replay", tables, replay::ReplayJson(command.run, task.notes, all),
                        stayed_up);
}

// Each walk in the worlds of the seeds.
ExitStatus ReplaySeeds(const Telling& telling) {
  const auto& [command, task, interrupt] = telling;
  std::vector<replay::SeedsPlayed> all;
  std::vector<CsvFile> tables;
  bool stayed_up = true;
  for (const replay::RecordedWalk& one : task.motions) {
    ProgressBar bar("seeds of " + one.method, !telling.screen());
    replay::SeedsPlayed& played = all.emplace_back(
        replay::SeedsPlayed{.method = one.method,
                            .duration = one.motion.end(),
                            .obstacles = task.setup.has_touchable(),
                            .seeds = replay::PlaySeeds(
                                task.setup, one.motion, *command.seeds,
                                [&bar](double done) { bar.Update(done); }, interrupt.token())});
    if (interrupt.requested()) return kInterrupted;
    stayed_up = stayed_up && replay::Standing(played.seeds) == *command.seeds;
    if (command.suggest_tube) {
      played.tube = replay::SuggestTube(replay::ResultsOf(played.seeds), task.setup.robot.model);
    }
    if (telling.screen()) std::cout << replay::SeedsText(played);
    tables.push_back(replay::SeedsCsv(played.seeds));
  }
  return telling.Finish("replays", tables, replay::SeedsJson(command.run, task.notes, all),
                        stayed_up);
}

int SeedsOf(const std::string& text) {
  const NumberText number = ParseNumber(text);
  const bool good = number.kind == NumberText::Kind::kNumber && number.value >= 1 &&
                    number.value <= kMostSeeds && number.value == std::floor(number.value);
  if (!good) {
    throw InputError({"--seeds " + Quote(text) + ": is no number of seeds (valid: 1 … " +
                      std::to_string(kMostSeeds) + ")"});
  }
  return static_cast<int>(number.value);
}

}  // namespace

ExitStatus Replay(const ReplayCommand& command) {
  if (command.seeds && command.push) {
    throw InputError({"--push: looks for the limit in one simulation (valid: without --seeds)"});
  }
  CheckTube(command);
  const Task task = IsEpisode(command.run) ? EpisodeTask(command) : RunTask(command);
  const std::vector<std::vector<double>> push_at = AllInstants(command, task);
  if (const std::string why = replay::WhyNoSimulation(); !why.empty()) {
    std::cerr << "halfstep: replay: " << why << '\n';
    return kFailed;
  }
  InterruptGuard interrupt;
  const Telling telling{command, task, interrupt};
  return command.seeds ? ReplaySeeds(telling) : ReplayOnce(telling, push_at);
}

CommandAction DeclareReplay(CLI::App* app, const Toolbox& tools) {
  const auto command = std::make_shared<ReplayCommand>();
  command->tools = tools;
  // CLI11 writes into these while it parses, so they must live as long as the action.
  struct Texts {
    std::string engine = "mujoco";
    std::optional<std::string> seeds;
  };
  const auto texts = std::make_shared<Texts>();
  app->add_option("RUN", command->run, "folder of a run or of an episode")->required();
  app->add_option("--engine", texts->engine, "mujoco")->check(OneOf({"mujoco"}));
  app->add_option("--method", command->method, "only this one (default: all)");
  const SimulatedRobotOptions robot = DeclareSimulatedRobot(app, &command->simulated);
  app->add_option(
      "--seeds", texts->seeds,
      "play each walk so often, with friction, contacts, stiffness, CoM and a push drawn");
  app->add_flag("--push", command->push, "find the largest push that each walk survives");
  app->add_option("--push-directions", command->push_directions, "of pushes: 4 (default) or 8")
      ->check(CLI::IsMember({4, 8}));
  app->add_option("--push-at", command->push_at, "instants of the push [s]");
  app->add_flag("--suggest-tube", command->suggest_tube,
                "print the `smoothing.tube` that holds where the robot is off its plan");
  app->add_flag(
      "--out", command->out,
      "write METHOD/replay.csv (episode: replay.csv; seeds: replays.csv) into the folder");
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  app->add_flag("--json", command->json, "print JSON");
  return [command, texts, robot] {
    robot.finish();
    if (texts->seeds) command->seeds = SeedsOf(*texts->seeds);
    return Replay(*command);
  };
}

}  // namespace halfstep
