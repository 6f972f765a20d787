#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/config/experiment.h"
#include "experiments/config/folder_name.h"
#include "experiments/replay/mujoco_model.h"
#include "experiments/replay/replay.h"
#include "experiments/run/interrupt.h"
#include "experiments/run/progress_bar.h"
#include "experiments/tables/certificate_files.h"
#include "experiments/tables/run_folder.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr double kDegree = std::numbers::pi / 180;

constexpr const char* kDisclaimer =
    "This is one simulation: soft point contacts, ideal servos without torque limits, the URDF's\n"
    "masses with estimated inertias, an upper body without joints. It guarantees nothing about "
    "the\n"
    "robot, and its falls are not proofs either.";

struct Replayed {
  std::string method;
  double duration = 0.0;
  replay::ReplayResult result;
  std::vector<replay::PushLimit> pushes;
};

// "forward", "left" …: the four directions of pushes.
const char* DirectionName(double direction) {
  const long quarter = std::lround(direction / (std::numbers::pi / 2));
  constexpr const char* kNames[] = {"forward", "left", "back", "right"};
  return kNames[quarter % 4];
}

void Print(const Replayed& replayed) {
  const replay::ReplayResult& result = replayed.result;
  std::cout << replayed.method << ": "
            << (result.stayed_up ? "stays up" : "FALLS at " + Formatted("%.2f s", result.ended))
            << ", walk of " << Formatted("%.3f s", replayed.duration) << ", largest tilt "
            << Formatted("%.1f deg", result.largest_tilt / kDegree) << ", ZMP off by "
            << Formatted("%.1f", 1e3 * result.zmp_rms) << " (rms) and "
            << Formatted("%.1f mm", 1e3 * result.zmp_largest) << " (largest; mass model alone "
            << Formatted("%.1f", 1e3 * result.model_rms) << " and "
            << Formatted("%.1f mm", 1e3 * result.model_largest) << "), slip "
            << Formatted("%.1f mm", 1e3 * result.slip) << ", drift "
            << Formatted("%.1f mm", 1e3 * result.drift) << '\n';
  for (const replay::PushLimit& push : replayed.pushes) {
    std::cout << "  pushed " << DirectionName(push.direction) << " at "
              << Formatted("%.2f s", push.at) << ": survives "
              << Formatted("%.1f N s", push.survived)
              << (std::isinf(push.fell) ? ", the most that was tried\n"
                                        : ", falls at " + Formatted("%.1f N s\n", push.fell));
  }
}

ordered_json Json(const Replayed& replayed) {
  const replay::ReplayResult& result = replayed.result;
  ordered_json json = {{"method", replayed.method},
                       {"duration_s", replayed.duration},
                       {"stayed_up", result.stayed_up},
                       {"ended_s", result.ended},
                       {"largest_tilt_rad", result.largest_tilt},
                       {"zmp_rms_m", result.zmp_rms},
                       {"zmp_largest_m", result.zmp_largest},
                       {"zmp_model_rms_m", result.model_rms},
                       {"zmp_model_largest_m", result.model_largest},
                       {"slip_m", result.slip},
                       {"drift_m", result.drift},
                       {"weight_share", result.weight_share}};
  for (const replay::PushLimit& push : replayed.pushes) {
    json["pushes"].push_back(
        {{"at_s", push.at},
         {"direction", DirectionName(push.direction)},
         {"survived_n_s", push.survived},
         {"fell_n_s", std::isinf(push.fell) ? ordered_json(nullptr) : ordered_json(push.fell)}});
  }
  return json;
}

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

/// A method's walk as the servos follow it.
struct NamedMotion {
  std::string method;
  replay::ReferenceMotion motion;
  std::vector<double> push_at;
};

std::vector<NamedMotion> ReadMotions(const ReplayCommand& command, const RobotModel& robot) {
  if (!command.push_at.empty() && !command.push) {
    throw InputError({"--push-at: without --push it says nothing"});
  }
  std::vector<NamedMotion> motions;
  for (const std::string& method : MethodsOfRun(command.run, command.method)) {
    const fs::path path = fs::path(command.run) / MethodFolder(method) / "trajectory.csv";
    replay::ReferenceMotion motion(ReadTrajectory(path, robot));
    const std::vector<double> push_at = Instants(command, motion.end());
    motions.push_back({method, std::move(motion), push_at});
  }
  return motions;
}

void WriteRows(const std::vector<Replayed>& all, const std::string& run) {
  RunFolder folder(run, /*overwrite=*/true);
  folder.CopyOlder();
  for (const Replayed& replayed : all) {
    WriteCsv(MethodFolder(replayed.method) + "/replay", ReplayCsv(replayed.result), &folder);
  }
  folder.Publish();
}

}  // namespace

ExitStatus Replay(const ReplayCommand& command) {
  const fs::path config_file = fs::path(command.run) / "config.yaml";
  MethodsOfRun(command.run, command.method);  // is it a run at all?
  const std::string robot_file = RobotPath(LoadConfig(config_file.string(), {})).string();
  const auto [robot, tree] = LoadWholeRobot(robot_file);
  const std::vector<NamedMotion> motions = ReadMotions(command, robot);
  if (const std::string why = replay::WhyNoSimulation(); !why.empty()) {
    std::cerr << "halfstep: replay: " << why << '\n';
    return kFailed;
  }
  InterruptGuard interrupt;
  const replay::Simulation simulation(replay::MujocoModel(robot, tree, {}), robot,
                                      tree.urdf.links[static_cast<size_t>(tree.waist)].name);
  std::vector<Replayed> all;
  bool stayed_up = true;
  for (const auto& [method, motion, push_at] : motions) {
    Replayed& replayed = all.emplace_back();
    replayed.method = method;
    replayed.duration = motion.end();
    replayed.result = replay::Play(simulation, motion, {});
    replay::CompareMassModel(robot, tree, motion, &replayed.result);
    stayed_up = stayed_up && replayed.result.stayed_up;
    if (command.push && replayed.result.stayed_up) {
      ProgressBar bar("pushes of " + method, command.quiet || command.json);
      replayed.pushes = replay::FindPushLimits(
          simulation, motion, {}, {}, push_at, [&bar](double done) { bar.Update(done); },
          interrupt.token());
    }
    if (interrupt.requested()) return kInterrupted;
    if (!command.quiet && !command.json) Print(replayed);
  }
  if (command.out) WriteRows(all, command.run);
  if (command.json) {
    ordered_json json = {{"run", command.run},
                         {"engine", "mujoco " + replay::EngineVersion()},
                         {"statement", kDisclaimer}};
    for (const Replayed& replayed : all) json["methods"].push_back(Json(replayed));
    std::cout << json.dump(2) << '\n';
  } else if (!command.quiet) {
    std::cout << '\n' << kDisclaimer << '\n';
  }
  return stayed_up ? kSuccess : kFailed;
}

CommandAction DeclareReplay(CLI::App* app) {
  const auto command = std::make_shared<ReplayCommand>();
  const auto engine = std::make_shared<std::string>("mujoco");
  app->add_option("RUN", command->run, "run folder")->required();
  app->add_option("--engine", *engine, "mujoco")->check(CLI::IsMember({"mujoco"}));
  app->add_option("--method", command->method, "only this one (default: all)");
  app->add_flag("--push", command->push, "find the largest push that each walk survives");
  app->add_option("--push-at", command->push_at, "instants of the push [s]");
  app->add_flag("--out", command->out, "write METHOD/replay.csv into the run folder");
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  app->add_flag("--json", command->json, "print JSON");
  // CLI11 writes into `engine` while it parses, so it must live as long as the action.
  return [command, engine] { return Replay(*command); };
}

}  // namespace halfstep
