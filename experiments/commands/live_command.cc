#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/live_clients.h"
#include "experiments/commands/push_option.h"
#include "experiments/commands/simulated_robot_options.h"
#include "experiments/live/episode.h"
#include "experiments/live/episode_files.h"
#include "experiments/live/episode_journal.h"
#include "experiments/live/episode_summary.h"
#include "experiments/live/free_half_steps.h"
#include "experiments/live/judged_promise.h"
#include "experiments/live/spare_boxes.h"
#include "experiments/replay/physics_record.h"
#include "experiments/run/interrupt.h"
#include "experiments/run/planning.h"
#include "experiments/run/progress_bar.h"
#include "experiments/tables/run_folder.h"
#include "smoothing/margins/not_covered_by.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

// The robot that executes the walk in physics.
replay::EpisodeRobot RobotOf(const LiveCommand& command, const LiveConfig& config,
                             ServedEpisode* served) {
  replay::SimulatedRobot simulated = command.simulated;
  if (served != nullptr) {
    simulated.controllers.Add(kClientController, MakeClientControllers(&served->control()));
  }
  replay::EpisodeRobot robot{
      .setup = simulated.SetupOf(LoadWholeRobot(RobotPath(config.experiment).string()), {}),
      .controller = command.simulated.controller,
      .pushes = command.pushes};
  if (robot.setup.relief.plates > 0.0) {
    throw InputError(
        {"--floor: plates lie where a walk lands, which an episode does not know "
         "before (valid: curb=H, slope=A)"});
  }
  return robot;
}

// `hooks`: without clients.
Episode Walk(const LiveConfig& config, const Replanner& replanner, const Place& place,
             Sensor* sensor, ServedEpisode* served, const EpisodeHooks& hooks) {
  const auto run = config.live.clock == "wall" ? RunWallClock : RunLockstep;
  const std::array<Foothold, 2> start =
      StartOf(config.experiment, place.robot, *place.scene.ground);
  if (served == nullptr) return run(replanner, sensor, start, hooks);
  const std::stop_callback end(hooks.stop, [served] { served->Stop(); });
  EpisodeHooks all = hooks;
  all.on_tick = [&](const EpisodeTick& tick) {
    hooks.on_tick(tick);
    served->Tick(tick);
  };
  all.on_wait = [served](const std::string& reason) { served->Wait(reason); };
  all.held = [served] { return served->held(); };
  all.ended = served->stop_token();
  return run(replanner, served->sensor() != nullptr ? served->sensor() : sensor, start, all);
}

// Lets a simulated robot say what it feels, and whether it fell.
void AddPhysics(replay::EpisodePhysics* simulated, EpisodeHooks* hooks) {
  hooks->waits = [simulated](Side support) { return simulated->Waits(support); };
  hooks->felt = [simulated] { return simulated->TakeFelt(); };
  hooks->fallen = [simulated] { return simulated->fallen(); };
  hooks->lost = [simulated] { return simulated->lost(); };
}

// What truly happened, in times of the walk, by the script and by what clients did; none when only
// they know.
std::optional<TrueWorld> WhatWasTrue(const LiveConfig& config, const Place& place,
                                     const replay::EpisodePhysics* simulated, double waited) {
  if (config.live.sensing.source != "stand_in") return std::nullopt;
  if (simulated != nullptr) return simulated->SeenByRobot().Since(waited);
  return TrueWorld(place.scene, config.experiment.goal, config.live).Since(waited);
}

// Whether the robot arrived, or was told to end, and touched nothing while it moved.
bool WentWell(const Episode& episode, const std::optional<replay::PhysicalOutcome>& outcome) {
  if (episode.promise.status() == PromiseStatus::kTouched) return false;
  if (outcome && (!outcome->lost.empty() || !outcome->replayed.result.stayed_up ||
                  std::ranges::count(outcome->replayed.result.touches, false,
                                     &replay::TouchRecord::at_rest) > 0)) {
    return false;
  }
  return episode.ending == EpisodeEnding::kArrived || episode.ending == EpisodeEnding::kEnded;
}

void PrintSummary(const LiveCommand& command, const Episode& episode, const TrueWorld* truth,
                  const Place& place, const LiveConfig& config, const std::string& folder,
                  const std::optional<replay::PhysicalOutcome>& outcome) {
  EpisodeSummary summary = Summarize(episode, truth, place.robot);
  summary.not_covered = NotCoveredBy(place.robot, place.scene, config.experiment.smoothing.limits);
  if (command.run.json) {
    const std::string json = SummaryJson(episode, summary, folder);
    std::cout << (outcome ? WithPhysics(json, *outcome) : json);
  } else if (!command.run.quiet) {
    std::cout << SummaryScreen(episode, summary, folder);
    if (outcome) std::cout << PhysicsText(*outcome);
  }
}

// What an episode replans with, and the half-steps that it borrows.
struct Thinking {
  std::shared_ptr<const SweptVolumes> volumes;  // null: by proofs
  std::unique_ptr<const Replanner> replanner;   // null when it was stopped
};

// `config` gets the form of half-steps that the ground asks for.
Thinking Prepare(const Place& place, bool silent, const std::stop_token& stop, LiveConfig* config) {
  Thinking made;
  if (FreeByProofs(place, config->experiment)) {
    const EpisodeForm form = FormFor(place, config->experiment, stop);
    config->experiment.half_step = form.half_step;
    if (stop.stop_requested()) return made;
    if (!form.why_none.empty()) {
      std::cerr << "halfstep: warning: no way to the goal even where nothing stands: "
                << form.why_none << '\n';
    }
    made.replanner = std::make_unique<const Replanner>(place, *config);
    return made;
  }
  ProgressBar bar("half-steps", silent);
  const auto baked = std::make_shared<const BakedHalfSteps>(BakeHalfSteps(
      place.robot, config->experiment,
      {.progress = [&bar](const std::string&, double done) { bar.Update(done); }, .stop = stop}));
  if (!baked->cached.volumes) return made;
  made.volumes = {baked, &*baked->cached.volumes};
  made.replanner = std::make_unique<const Replanner>(place, *config, *made.volumes);
  return made;
}

// A name for the folder of the episode that begins anew for the `number`-th time: "runs/a_2", or
// the next one that is free.
fs::path NextFolder(const fs::path& first, bool overwrite, int* number) {
  const auto named = [&] { return fs::path(first.string() + Formatted("_%d", ++*number)); };
  fs::path next = named();
  while (!overwrite && (fs::exists(fs::symlink_status(next)) ||
                        fs::exists(fs::symlink_status(EpisodeJournal::FolderOf(next))))) {
    next = named();
  }
  return next;
}

// What all episodes of a command have; borrowed.
struct Prepared {
  const LiveCommand& command;
  const LiveConfig& config;
  const Place& place;
  const TrueWorld& truth;
  const Thinking& thinking;
  InterruptGuard& interrupt;
};

// One episode, from the first look at the world to its folder. `served`, `simulated`: null where
// there are no clients, and no physics.
ExitStatus WalkOnce(const Prepared& all, ServedEpisode* served, replay::EpisodePhysics* simulated,
                    RunFolder* folder) {
  const auto& [command, initial, place, truth, thinking, interrupt] = all;
  LiveConfig config = initial;
  if (served != nullptr) served->Prepare(thinking.volumes);
  if (command.wait) served->WaitForClient(interrupt.token());
  std::optional<ProgressBar> bar;
  bar.emplace("episode", command.run.quiet || command.run.json);
  EpisodeJournal journal(folder->path(), config, command.run.overwrite);
  interrupt.Keep("halfstep recover " + folder->path().string());
  const TrueWorld seen = simulated != nullptr ? simulated->SeenByRobot() : truth;
  StandInSensor sensor(seen, config.live, static_cast<std::uint64_t>(config.experiment.seed) + 1);
  const auto on_tick = [&](const EpisodeTick& tick) {
    if (simulated != nullptr) simulated->Play(tick);
    journal.Write(tick);
    bar->Update(tick.now / config.live.longest);
  };
  EpisodeHooks hooks{.on_tick = on_tick, .stop = interrupt.token()};
  if (simulated != nullptr) AddPhysics(simulated, &hooks);
  Episode episode = Walk(config, *thinking.replanner, place, &sensor, served, hooks);
  bar.reset();
  if (!journal.failure().empty()) std::cerr << "halfstep: warning: " << journal.failure() << '\n';
  if (served != nullptr && served->sensor() != nullptr) config.live.script = served->Script();
  const std::optional<TrueWorld> was_true = WhatWasTrue(config, place, simulated, episode.waited);
  episode.promise = JudgePromise(episode, was_true ? &*was_true : nullptr, place, config.live);
  if (simulated != nullptr) episode.promise.judged_by = "simulation";
  WriteEpisode(episode, config, place, folder);
  std::optional<replay::PhysicalOutcome> outcome;
  if (simulated != nullptr) {
    outcome = simulated->Finish(episode);
    WritePhysics(*outcome, place.robot, place.scene, folder);
  }
  folder->Publish();
  journal.Remove();
  PrintSummary(command, episode, was_true ? &*was_true : nullptr, place, config,
               folder->path().string(), outcome);
  std::cout << std::flush;  // before clients go, and perhaps come again
  if (served != nullptr) served->End(episode, folder->path().string());
  if (interrupt.requested() && episode.ending != EpisodeEnding::kArrived) return kInterrupted;
  return WentWell(episode, outcome) ? kSuccess : kFailed;
}

}  // namespace

ExitStatus Live(const LiveCommand& command) {
  InterruptGuard interrupt;
  LoadedEpisode loaded = LoadEpisode(
      command.run.config, command.run.overrides,
      [&](const LiveConfig& config) { return Adapted(command, config); }, command.run.tools);
  LiveConfig& config = loaded.config;
  const Place& place = loaded.place;
  TellWarnings(place.robot, place.scene);
  const TrueWorld truth(place.scene, config.experiment.goal, config.live);
  std::unique_ptr<ServedEpisode> served =
      Serve(command, config, place, truth, interrupt.token(), "");
  // What the options of the simulated robot say is refused before anything is computed, and so is a
  // folder that is in the way.
  std::optional<replay::EpisodePhysics> simulated;
  if (command.in_physics) {
    simulated.emplace(RobotOf(command, config, served.get()), truth, config.live);
  }
  const fs::path out = OutputFolder(command.run, config.experiment);
  std::optional<RunFolder> folder(std::in_place, out, command.run.overwrite);
  if (served) PrintPlaces(command, *served);
  const Thinking thinking =
      Prepare(place, command.run.quiet || command.run.json, interrupt.token(), &config);
  if (!thinking.replanner) {
    std::cerr << "halfstep: interrupted before the episode began\n";
    return kInterrupted;
  }
  const Prepared all{command, config, place, truth, thinking, interrupt};
  for (int number = 1;;) {
    const ExitStatus status =
        WalkOnce(all, served.get(), simulated ? &*simulated : nullptr, &*folder);
    if (!served || !served->again() || interrupt.requested()) return status;
    const std::string address = served->address();
    served.reset();  // its socket goes with it
    served = Serve(command, config, place, truth, interrupt.token(), address);
    folder.emplace(NextFolder(out, command.run.overwrite, &number), command.run.overwrite);
  }
}

CommandAction DeclareLive(CLI::App* app, const Toolbox& tools) {
  const auto command = std::make_shared<LiveCommand>();
  command->run.tools = tools;
  const auto sets = std::make_shared<std::vector<std::string>>();
  app->add_option("CONFIG", command->run.config,
                  "episode, a YAML file with `live`, or a shipped one's name")
      ->required();
  DeclareOverrides(app, "the config", sets.get());
  app->add_option("--out", command->run.out, "folder (default: output.directory, or runs/NAME)");
  CLI::Option* const view =
      app->add_flag("--view", command->view,
                    "serve a page that shows the episode and lets people take part, on this "
                    "machine only; its address is printed");
  app->add_option("--port", command->port, "of the page (default: any that is free)")
      ->check(CLI::Range(0, 65535))
      ->needs(view);
  CLI::Option* const serve = app->add_option(
      "--serve", command->socket, "serve the same messages by a Unix-domain socket of this path");
  app->add_flag("--wait", command->wait, "with --view or --serve: begins when a client has come");
  CLI::Option* const in_physics =
      app->add_flag("--in-physics", command->in_physics,
                    "a robot simulated by MuJoCo executes the walk; the world is measured from it")
          ->excludes(view);
  const SimulatedRobotOptions robot = DeclareSimulatedRobot(app, &command->simulated);
  for (CLI::Option* option : robot.all) option->needs(in_physics);
  const auto pushes = std::make_shared<std::vector<std::string>>();
  app->add_option(
         "--push", *pushes,
         "T,FX,FY,SECONDS: from the time T [s] of the walk on a force [N] on the waist; may "
         "be given again")
      ->take_all()
      ->needs(in_physics);
  app->add_option("--answer-within", command->answer_within,
                  "ends the episode when a client that controls does not answer for so long [s] "
                  "(default: waits)")
      ->check(CLI::Range(0.001, 86400.0))
      ->needs(serve);
  DeclareRunFlags(app, &command->run);
  return [command, sets, robot, pushes] {
    robot.finish();
    command->pushes = PushesOf(*pushes);
    command->run.overrides = ParseOverrides(*sets);
    return Live(*command);
  };
}

}  // namespace halfstep
