#include <iostream>
#include <memory>
#include <optional>

#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/live/episode.h"
#include "experiments/live/episode_files.h"
#include "experiments/live/episode_summary.h"
#include "experiments/replay/physics_record.h"
#include "experiments/run/interrupt.h"
#include "experiments/run/planning.h"
#include "experiments/run/progress_bar.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

void Print(const RunCommand& command, const std::string& folder, const Episode& episode,
           const EpisodeSummary& summary, const std::optional<replay::PhysicalOutcome>& outcome) {
  if (command.json) {
    const std::string json = SummaryJson(episode, summary, folder);
    std::cout << (outcome ? WithPhysics(json, *outcome) : json);
  } else if (!command.quiet) {
    std::cout << SummaryScreen(episode, summary, folder);
    if (outcome) std::cout << PhysicsText(*outcome);
  }
}

}  // namespace

ExitStatus Live(const LiveCommand& options) {
  const RunCommand& command = options.run;
  InterruptGuard interrupt;
  const LiveConfig config = LoadLiveConfig(command.config, command.overrides);
  const Place place = LoadPlace(config.experiment);
  TrueWorld truth(place.scene, config.experiment.goal, config.live);
  if (const std::string why = replay::WhyNoSimulation(); options.in_physics && !why.empty()) {
    std::cerr << "halfstep: live --in-physics: " << why << '\n';
    return kFailed;
  }
  std::optional<ProgressBar> bar;
  bar.emplace("half-steps", command.quiet || command.json);
  const BakedHalfSteps baked =
      BakeHalfSteps(place.robot, config.experiment,
                    {.progress = [&bar](const std::string&, double done) { bar->Update(done); },
                     .stop = interrupt.token()});
  if (!baked.cached.volumes) {
    bar.reset();
    std::cerr << "halfstep: interrupted while half-steps were baked\n";
    return kInterrupted;
  }
  const Replanner replanner(place.robot, config, *baked.cached.volumes);
  RunFolder folder(OutputFolder(command, config.experiment), command.overwrite);
  std::optional<WholeRobot> whole;
  std::optional<replay::EpisodePhysics> physics;
  if (options.in_physics) {
    whole = LoadWholeRobot(RobotPath(config.experiment).string());
    physics.emplace(*whole, truth, config.live);
    truth = physics->SeenByRobot();
  }
  bar.emplace("episode", command.quiet || command.json);
  const auto run = config.live.clock == "wall" ? RunWallClock : RunLockstep;
  StandInSensor sensor(truth, config.live, static_cast<std::uint64_t>(config.experiment.seed) + 1);
  const Episode episode = run(replanner, &sensor, StartOf(config.experiment, place.robot),
                              {.on_tick =
                                   [&](const EpisodeTick& tick) {
                                     if (physics) physics->Play(tick);
                                     bar->Update(tick.now / config.live.longest);
                                   },
                               .held = {},
                               .fallen = [&] { return physics && physics->fallen(); },
                               .stop = interrupt.token()});
  bar.reset();
  WriteEpisode(episode, replanner, place.scene, &folder);
  std::optional<replay::PhysicalOutcome> outcome;
  if (physics) {
    outcome = physics->Finish(episode);
    WritePhysics(*outcome, place.robot, place.scene, &folder);
  }
  folder.Publish();
  const EpisodeSummary summary = Summarize(episode, truth, place.robot);
  Print(command, folder.path().string(), episode, summary, outcome);
  if (episode.ending == EpisodeEnding::kInterrupted) return kInterrupted;
  const bool fell = outcome && !outcome->replayed.result.stayed_up;
  return episode.ending == EpisodeEnding::kArrived && !fell ? kSuccess : kFailed;
}

CommandAction DeclareLive(CLI::App* app) {
  const auto command = std::make_shared<LiveCommand>();
  const auto sets = std::make_shared<std::vector<std::string>>();
  app->add_option("CONFIG", command->run.config, "episode, a YAML file with `live`")->required();
  DeclareOverrides(app, "the config", sets.get());
  app->add_option("--out", command->run.out, "folder (default: output.directory, or runs/NAME)");
  app->add_flag("--in-physics", command->in_physics,
                "a robot simulated by MuJoCo executes the walk; the world is measured from it");
  DeclareRunFlags(app, &command->run);
  return [command, sets] {
    command->run.overrides = ParseOverrides(*sets);
    return Live(*command);
  };
}

}  // namespace halfstep
