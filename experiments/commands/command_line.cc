#include "experiments/commands/command_line.h"

#include <iostream>

#include "experiments/about/build_info.h"
#include "experiments/commands/command_mistake.h"
#include "experiments/commands/commands.h"
#include "experiments/config/experiment_config.h"
#include "wpg/files/input_error.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

namespace {

constexpr CommandEntry kEntries[] = {
    {"init",
     "Write a config to begin with, commented.\n\n"
     "  example: halfstep init my_walk --robot hrp2 --goal 2 0.5",
     DeclareInit},
    {"run",
     "Concatenate, smooth with each method, write the run folder.\n\n"
     "  example: halfstep run bar_8cm --set "
     "smoothing.margins.clearance_m=0.004",
     DeclareRun},
    {"smooth",
     "Smooth given footsteps with each method, write a run folder.\n\n"
     "  example: halfstep smooth runs/bar_8cm --method ipopt --method halfstep/barrier\n"
     "  example: halfstep smooth runs/bar_8cm --given overlaps.csv --given half_steps.csv",
     DeclareSmooth},
    {"compare",
     "Compare the methods of runs; failures count as failures.\n\n"
     "  example: halfstep compare runs/bar_5cm runs/bar_8cm --out runs/bars",
     DeclareCompare},
    {"plan",
     "Plan footsteps to the goal of a config and print them as YAML.\n\n"
     "  example: halfstep plan island --set planner.name=astar",
     DeclarePlan},
    {"bake",
     "Certify a config's set of half-steps and bake their swept volumes into the cache.\n\n"
     "  example: halfstep bake island",
     DeclareBake},
    {"draw",
     "Print a scene that is drawn at random, as YAML.\n\n"
     "  example: halfstep draw cylinders --count 40 --seed 1",
     DeclareDraw},
    {"certify",
     "Prove the walks of a run for all time and write the certificates.\n\n"
     "  example: halfstep certify runs/bar_8cm --set smoothing.resolution_s=1e-5",
     DeclareCertify},
    {"robot",
     "Make a robot file of a URDF, and walk six steps with it.\n\n"
     "  example: halfstep robot wpg/robots/hrp2.urdf --package hrp2_bodies=wpg/robots/hrp2 "
     "--out runs/guess.yaml",
     DeclareRobot},
    {"scene",
     "Make a scene file of what other programs have: MoveIt, URDF, SDF, meshes, clouds, maps.\n\n"
     "  example: halfstep scene room.world --models models --out room.yaml",
     DeclareScene},
    {"check",
     "Prove of anybody's joint trajectory that it keeps limits and clearances between its "
     "knots,\nor of a run's walks what their certificates demand, in interval arithmetic.\n\n"
     "  example: halfstep check arm.csv --robot arm.urdf --scene table.yaml --clearance 0.01\n"
     "  example: halfstep check runs/bar_8cm",
     DeclareCheck},
    {"verify",
     "Check a run's certificates independently: played motion, forward kinematics, distances\n"
     "of its own; none of the code that smoothed. Exit status 3 when it disagrees, 4 when the\n"
     "rows are too coarse to tell.\n\n"
     "  example: halfstep verify runs/bar_8cm --method dichotomy",
     DeclareVerify},
    {"live",
     "Let a robot walk while the world changes: an episode, into a folder.\n\n"
     "  example: halfstep live live_bar",
     DeclareLive},
    {"recover",
     "Write the folder of an episode whose process was killed, from the record that it left.\n\n"
     "  example: halfstep recover runs/live_bar",
     DeclareRecover},
    {"sweep",
     "Run a config with every combination of some keys; the same command goes on where it was\n"
     "stopped.\n\n"
     "  example: halfstep sweep bar_8cm_speed_clearance --jobs 2",
     DeclareSweep},
    {"bench",
     "Scenes of clutter below, beside and overhead, by difficulty and seed, and how planners do "
     "in\nthem; the same command goes on where it was stopped.\n\n"
     "  example: halfstep bench --kinds below,overhead --seeds 5 --out runs/bench",
     DeclareBench},
    {"explain-config",
     "Every key of a config: type, unit, default, range, meaning.\n\n"
     "  example: halfstep explain-config smoothing.margins",
     DeclareExplain},
    {"report",
     "Write a run's report anew: one HTML file that shows its walks.\n\n"
     "  example: halfstep report runs/bar_8cm --out bar_8cm.html",
     DeclareReport},
    {"plot",
     "Draw a figure for a paper: of a run, a comparison or a sweep.\n\n"
     "  example: halfstep plot runs/bar_8cm --what walk,zmp --method raw,dichotomy bar_8cm.pdf",
     DeclarePlot},
    {"export",
     "Write the walks of a run in other programs' formats.\n\n"
     "  example: halfstep export runs/bar_8cm --format hrpsys --method dichotomy\n"
     "  example: halfstep export runs/bar_8cm --format csv --columns 'com_*' 'q_R*'\n"
     "  example: halfstep export runs/bar_8cm --format mjcf --method dichotomy",
     DeclareExport},
    {"replay",
     "Play the walks of a run on a robot with masses and contacts, by simulation.\n\n"
     "  example: halfstep replay runs/bar_8cm --method dichotomy --push",
     DeclareReplay},
    {"list", "What there is.\n\n  example: halfstep list methods", DeclareList},
};

// Version and commit, and on a line of its own what it was built with.
std::string VersionText() {
  std::string text = std::string(kVersion) + " (" + std::string(kCommit) + ")\n";
  text += std::string(kBuildType) + ", " + std::string(kCompiler);
  for (const auto& [library, version] : kLibraries) {
    text += ", " + std::string(library) + " " + std::string(version);
  }
  return text;
}

}  // namespace

std::span<const CommandEntry> CommandEntries() { return kEntries; }

std::vector<DeclaredCommand> DeclareProgram(CLI::App* app, const Toolbox& tools) {
  app->description(
      "Plans and smooths humanoid walks made of half-steps.\n\n"
      "  example: halfstep run bar_8cm");
  app->set_version_flag("--version", VersionText());
  app->require_subcommand(0, 1);  // none at all is told later, so that a misspelt one is named
  std::vector<DeclaredCommand> commands;
  for (const CommandEntry& entry : CommandEntries()) {
    CLI::App* const command = app->add_subcommand(entry.name, entry.help);
    commands.emplace_back(command, entry.declare(command, tools));
    RefuseDecimalCommas(command);
  }
  return commands;
}

void DeclareOverrides(CLI::App* app, const std::string& what, std::vector<std::string>* sets) {
  app->add_option("--set", *sets, "override a key of " + what + ": KEY=VALUE")
      ->allow_extra_args(false);
}

std::vector<YamlOverride> ParseOverrides(const std::vector<std::string>& sets,
                                         const std::string& option) {
  std::vector<YamlOverride> overrides;
  for (const std::string& text : sets) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw InputError(
          {option + " " + text + ": not an assignment (valid: " +
           (option == "--set" ? "--set smoothing.sampling_s=0.002" : option + " NAME=VALUE") +
           ")"});
    }
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return overrides;
}

std::filesystem::path OutputFolder(const RunCommand& command, const ExperimentConfig& config) {
  if (command.out && command.out->empty()) {
    throw InputError({"--out: no folder is named (valid: a path)"});
  }
  if (command.out) return *command.out;
  if (!config.output_directory.empty()) {
    return std::filesystem::path(config.directory) / config.output_directory;
  }
  return std::filesystem::path("runs") / config.name;
}

void TellWarnings(const RobotModel& robot, const Scene& scene) {
  for (const auto& warnings : {robot.warnings, scene.warnings}) {
    for (const std::string& warning : warnings) {
      std::cerr << "halfstep: warning: " << warning << '\n';
    }
  }
}

void TellUnder(const std::string& heading, const std::vector<std::string>& lines) {
  std::cerr << "halfstep: " << heading << '\n';
  for (const std::string& line : lines) std::cerr << "  " << line << '\n';
}

}  // namespace halfstep
