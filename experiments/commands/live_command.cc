#include <iostream>
#include <memory>
#include <optional>

#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/live/episode.h"
#include "experiments/live/episode_files.h"
#include "experiments/live/episode_journal.h"
#include "experiments/live/episode_summary.h"
#include "experiments/run/interrupt.h"
#include "experiments/run/planning.h"
#include "experiments/run/progress_bar.h"
#include "wpg/files/input_error.h"

namespace halfstep {

ExitStatus Live(const RunCommand& command) {
  InterruptGuard interrupt;
  const LiveConfig config = LoadLiveConfig(command.config, command.overrides);
  const Place place = LoadPlace(config.experiment);
  const TrueWorld truth(place.scene, config.experiment.goal, config.live);
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
  bar.emplace("episode", command.quiet || command.json);
  const auto run = config.live.clock == "wall" ? RunWallClock : RunLockstep;
  EpisodeJournal journal(folder.path(), config, command.overwrite);
  interrupt.Keep();
  StandInSensor sensor(truth, config.live, static_cast<std::uint64_t>(config.experiment.seed) + 1);
  const Episode episode = run(replanner, &sensor, StartOf(config.experiment, place.robot),
                              {.on_tick =
                                   [&](const EpisodeTick& at) {
                                     journal.Write(at);
                                     bar->Update(at.now / config.live.longest);
                                   },
                               .held = {},
                               .stop = interrupt.token()});
  bar.reset();
  if (!journal.failure().empty()) std::cerr << "halfstep: warning: " << journal.failure() << '\n';
  WriteEpisode(episode, config, place, &folder);
  folder.Publish();
  journal.Remove();
  const EpisodeSummary summary = Summarize(episode, truth, place.robot);
  if (command.json) {
    std::cout << SummaryJson(episode, summary, folder.path().string());
  } else if (!command.quiet) {
    std::cout << SummaryScreen(episode, summary, folder.path().string());
  }
  if (episode.ending == EpisodeEnding::kInterrupted) return kInterrupted;
  return episode.ending == EpisodeEnding::kArrived ? kSuccess : kFailed;
}

CommandAction DeclareLive(CLI::App* app) {
  const auto command = std::make_shared<RunCommand>();
  const auto sets = std::make_shared<std::vector<std::string>>();
  app->add_option("CONFIG", command->config, "episode, a YAML file with `live`")->required();
  DeclareOverrides(app, "the config", sets.get());
  app->add_option("--out", command->out, "folder (default: output.directory, or runs/NAME)");
  DeclareRunFlags(app, command.get());
  return [command, sets] {
    command->overrides = ParseOverrides(*sets);
    return Live(*command);
  };
}

}  // namespace halfstep
