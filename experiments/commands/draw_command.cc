#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "experiments/commands/command_line.h"
#include "experiments/commands/command_mistake.h"
#include "experiments/commands/draw_references.h"
#include "experiments/config/experiment.h"
#include "experiments/config/random_scenes.h"
#include "experiments/run/exit_status.h"
#include "experiments/survey/drawn_walk.h"
#include "wpg/files/input_error.h"
#include "wpg/files/partial_sibling.h"
#include "wpg/files/text.h"
#include "wpg/files/whole_file.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

constexpr int kMostWalks = 1000;

struct DrawCommand {
  std::string what, robot = "hrp2", out;
  int count = 0, seed = 1;
};

// The folder of walks and the sweep over them, under its name whole or not at all.
ExitStatus DrawWalks(const DrawCommand& command) {
  if (command.out.empty())
    throw InputError({"draw: walks: --out is missing (valid: a new folder)"});
  const fs::path folder = fs::absolute(command.out).lexically_normal();
  if (fs::exists(folder)) throw InputError({command.out + ": is there already"});
  const int count = command.count == 0 ? 60 : command.count;
  if (count > kMostWalks) {
    throw InputError({Formatted("--count: %d walks (valid: 1 … %d)", count, kMostWalks)});
  }
  ExperimentConfig config;  // its paths are relative to the working directory
  config.robot = command.robot;
  config.scene = "none";
  const Place place = LoadPlace(config);
  const std::string robot = fs::is_regular_file(command.robot)
                                ? fs::absolute(command.robot).lexically_normal().string()
                                : command.robot;
  std::mt19937_64 random(static_cast<std::uint64_t>(command.seed));
  fs::create_directories(folder.parent_path());
  PartialSibling files(folder, PartialSibling::Kind::kFolder);
  std::string sweep = Formatted(
      "# halfstep draw walks --count %d --seed %d\n# Walks that nobody tuned for; `config` varies, "
      "the other keys are the same in every case.\nconfig: walk_%0*d.yaml\nvary:\n"
      "  - {key: smoothing.methods, values: [\"[dichotomy, dichotomy/uniform, halfstep/sqp, "
      "reference/lipm]\"]}\n"
      "  - {key: smoothing.optimizer.heights, values: [true]}\n"
      "  - {key: smoothing.optimizer.durations, values: [true]}\n"
      "  - key: config\n    values:\n",
      count, command.seed, static_cast<int>(std::to_string(count).size()), 1);
  for (int i = 1; i <= count; ++i) {
    const std::string name =
        Formatted("walk_%0*d", static_cast<int>(std::to_string(count).size()), i);
    const DrawnWalk walk = DrawWalk(name, robot, place.robot, random);
    WriteWhole(files.path() / (name + ".yaml"), {walk.config});
    WriteWhole(files.path() / (name + "_scene.yaml"), {walk.scene});
    sweep += "      - " + name + ".yaml  # " + walk.kind + "\n";
  }
  WriteWhole(files.path() / "walks.yaml", {sweep});
  fs::rename(files.path(), folder);
  files.Release();
  std::cout << "written: " << command.out << "\nnext:    halfstep sweep "
            << (fs::path(command.out) / "walks.yaml").string() << '\n';
  return kSuccess;
}

}  // namespace

CommandAction DeclareDraw(CLI::App* app, const Toolbox&) {
  const auto command = std::make_shared<DrawCommand>();
  std::vector<std::string> kinds = RandomSceneNames();
  kinds.push_back("walks");
  kinds.push_back("references");
  const auto references = std::make_shared<ReferencesCommand>();
  references->jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  app->add_option(
         "WHAT", command->what,
         "a scene, cylinders, random_room or blocks, which is printed; walks, a folder of configs "
         "and a sweep over them; or references, a folder of certified motions")
      ->required()
      ->check(OneOf(kinds));
  app->add_option("--count", command->count,
                  "obstacles (default: 40), walks (default: 60), or references (default: 1000)")
      ->check(CLI::Range(0, 100000));
  app->add_option("--seed", command->seed, "of the draw (default: 1)")
      ->check(CLI::Range(0, 2147483647));
  app->add_option("--out", command->out,
                  "of walks: the folder, which must be new; of references: a folder, or one that "
                  "is not finished");
  app->add_option("--robot", command->robot,
                  "of walks and references: name or file of a robot (default: hrp2)");
  std::vector<CLI::Option*> of_references;
  of_references.push_back(
      app->add_option("--format", references->request.formats,
                      "of references, one or more: mjlab, lafan1, json, csv (default: mjlab)")
          ->check(OneOf({"mjlab", "lafan1", "json", "csv"})));
  of_references.push_back(app->add_option("--fps", references->request.fps,
                                          "of references: frames a second (default: 50; lafan1: "
                                          "30)")
                              ->check(CLI::Range(1, 1000)));
  of_references.push_back(app->add_option("--method", references->request.method,
                                          "of references: of smoothing (default: dichotomy)"));
  of_references.push_back(app->add_option("--jobs", references->jobs,
                                          "of references: at a time (default: as many as "
                                          "cores)")
                              ->check(CLI::Range(1, 1024)));
  of_references.push_back(
      app->add_flag("--quiet", references->quiet, "of references: print nothing but errors"));
  const auto sets = std::make_shared<std::vector<std::string>>();
  DeclareOverrides(app, "the configs of references", sets.get());
  of_references.push_back(app->get_option("--set"));
  const CLI::Option* count = app->get_option("--count");
  return [command, references, of_references, sets, count]() -> int {
    if (command->what == "references") {
      references->request.robot = command->robot;
      references->request.seed = command->seed;
      references->request.overrides = ParseOverrides(*sets);
      if (count->count() > 0) references->request.count = command->count;
      references->out = command->out;
      return DrawReferences(*references);
    }
    for (const CLI::Option* option : of_references) {
      if (option->count() == 0) continue;
      throw InputError({"draw: " + option->get_name() + " is for references"});
    }
    if (command->what == "walks") return DrawWalks(*command);
    if (!command->out.empty()) throw InputError({"draw: --out is for walks (a scene is printed)"});
    std::cout << DrawScene(command->what, count->count() == 0 ? 40 : command->count,
                           static_cast<std::uint64_t>(command->seed));
    return kSuccess;
  };
}

}  // namespace halfstep
