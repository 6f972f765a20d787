#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <mutex>
#include <thread>

#include "experiments/bench/bench_folder.h"
#include "experiments/bench/bench_footsteps.h"
#include "experiments/commands/command_line.h"
#include "experiments/commands/command_mistake.h"
#include "experiments/config/experiment.h"
#include "experiments/run/exit_status.h"
#include "experiments/run/interrupt.h"
#include "experiments/run/progress_bar.h"
#include "wpg/files/input_error.h"
#include "wpg/files/partial_sibling.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/robot/robot_model.h"
#include "wpg/workers.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

struct BenchCommand {
  BenchSelection selection;
  bool list = false;
  std::string write, out;
  int jobs = 1;
  bool quiet = false;
};

// Each once, in the order of the benchmark.
void Tidy(BenchSelection* selection) {
  const std::vector<std::string> all = BenchKinds();
  std::erase_if(selection->kinds, [](const std::string& kind) { return kind.empty(); });
  std::ranges::sort(selection->kinds, {}, [&](const std::string& kind) {
    return std::ranges::find(all, kind) - all.begin();
  });
  std::ranges::sort(selection->difficulties);
  const auto once = [](auto* list) {
    list->erase(std::ranges::unique(*list).begin(), list->end());
  };
  once(&selection->kinds);
  once(&selection->difficulties);
}

void CheckPlanners(const BenchSelection& selection) {
  const std::vector<std::string> names = selection.tools.planners.Names();
  for (const std::string& name : selection.planners) {
    if (std::ranges::find(names, name) == names.end()) {
      throw InputError(
          {"--planners: " + Quote(name) + ": no such planner" + Suggestion(name, names)});
    }
    if (std::ranges::count(selection.planners, name) > 1) {
      throw InputError({"--planners: " + Quote(name) + ": more than once (valid: each once)"});
    }
  }
}

// The robot, with its name in configs that may lie anywhere.
RobotModel LoadBenchRobot(BenchSelection* selection) {
  if (fs::is_regular_file(selection->robot)) {
    selection->robot = fs::absolute(selection->robot).lexically_normal().string();
  }
  ExperimentConfig config;
  config.robot = selection->robot;
  config.scene = "none";
  return LoadPlace(config).robot;
}

// The folder of scenes, under its name whole or not at all.
void WriteScenes(const BenchCommand& command, const BenchSizes& sizes) {
  const fs::path folder = fs::absolute(command.write).lexically_normal();
  if (fs::exists(fs::symlink_status(folder))) {
    throw InputError({"--write: " + command.write + ": is there already (valid: a new folder)"});
  }
  fs::create_directories(folder.parent_path());
  PartialSibling files(folder, PartialSibling::Kind::kFolder);
  WriteBenchScenes(command.selection, sizes, files.path());
  fs::rename(files.path(), folder);
  files.Release();
  if (command.quiet) return;
  const std::string first = KeysOf(command.selection).front().Name() + ".yaml";
  std::cout << "written: " << command.write << ", " << KeysOf(command.selection).size()
            << " scenes\nnext:    halfstep run " << (fs::path(command.write) / first).string()
            << '\n';
}

int RunBench(const BenchCommand& command, const RobotModel& robot) {
  InterruptGuard interrupt;
  const BenchSelection& selection = command.selection;
  TellWarnings(robot);
  const BenchFolder folder(command.out, selection, robot);
  const std::vector<BenchCase> cases = CasesOf(selection);
  std::vector<BenchCase> missing;
  std::ranges::copy_if(cases, std::back_inserter(missing),
                       [&](const BenchCase& one) { return !folder.IsDone(one); });
  if (!command.quiet && missing.size() < cases.size()) {
    std::cout << cases.size() - missing.size() << " of " << cases.size()
              << " cases are done already\n"
              << std::flush;
  }
  interrupt.Keep();
  std::mutex mutex;  // of what follows
  size_t done = 0;
  {
    ProgressBar bar("bench", command.quiet);
    Workers workers(command.jobs);
    workers.Run(static_cast<int>(missing.size()), [&](int index, int) {
      if (interrupt.requested()) return false;
      const BenchCase& one = missing[static_cast<size_t>(index)];
      const auto row = DoBenchCase(selection, one, folder.scenes(), interrupt.token());
      if (!row) return false;
      folder.Write(one, *row);
      const std::lock_guard<std::mutex> lock(mutex);
      bar.Update(static_cast<double>(++done) / static_cast<double>(missing.size()));
      return true;
    });
  }
  if (done < missing.size()) {
    std::cerr << "halfstep: stopped; " << missing.size() - done << " of " << cases.size()
              << " cases are not done (the same command goes on)\n";
    return kInterrupted;
  }
  const std::string table = folder.Collect(cases);
  if (!command.quiet) {
    std::cout << robot.name << ", " << KeysOf(selection).size() << " scenes\n"
              << BenchTable(table) << "written: " << (fs::path(command.out) / "bench.csv").string()
              << '\n';
  }
  return kSuccess;
}

int Bench(BenchCommand command) {
  BenchSelection& selection = command.selection;
  Tidy(&selection);
  const int ways =
      (command.list ? 1 : 0) + (command.write.empty() ? 0 : 1) + (command.out.empty() ? 0 : 1);
  if (ways != 1) {
    throw InputError(
        {"bench: what shall be done is not said, or more than one thing (valid: one of "
         "--list, --write FOLDER, --out FOLDER)"});
  }
  if (!selection.footsteps.empty() && command.out.empty()) {
    throw InputError({"bench: --footsteps are checked into --out FOLDER"});
  }
  if (!selection.footsteps.empty()) selection.planners.clear();
  CheckPlanners(selection);
  const RobotModel robot = LoadBenchRobot(&selection);
  const BenchSizes sizes = BenchSizesOf(robot);
  if (command.list) {
    std::cout << BenchScenesCsv(selection, sizes).text;
    return kSuccess;
  }
  if (!command.write.empty()) {
    WriteScenes(command, sizes);
    return kSuccess;
  }
  if (!selection.footsteps.empty()) CheckFootsteps(selection, sizes);
  return RunBench(command, robot);
}

}  // namespace

CommandAction DeclareBench(CLI::App* app, const Toolbox& tools) {
  const auto command = std::make_shared<BenchCommand>();
  BenchSelection& selection = command->selection;
  selection.tools = tools;
  selection.kinds = BenchKinds();
  selection.planners = {"best", "rrt", "astar"};
  for (int i = 1; i <= kMostDifficult; ++i) selection.difficulties.push_back(i);
  command->jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  app->add_flag("--list", command->list, "print the scenes and their numbers as CSV");
  app->add_option("--write", command->write, "write scenes and configs into this new folder");
  app->add_option("--out", command->out,
                  "plan in every scene, smooth and certify; into this folder, or one that is not "
                  "finished");
  app->add_option("--kinds", selection.kinds, "of clutter (default: all)")
      ->delimiter(',')
      ->check(OneOf(BenchKinds()));
  app->add_option("--difficulties", selection.difficulties, "1 to 5 (default: all)")
      ->delimiter(',')
      ->check(CLI::Range(1, kMostDifficult));
  app->add_option("--seeds", selection.seeds, "draws of each: seeds 1 to this (default: 3)")
      ->check(CLI::Range(1, kMostBenchSeed));
  app->add_option("--robot", selection.robot, "name or file of a robot (default: hrp2)");
  CLI::Option* planners =
      app->add_option("--planners", selection.planners, "that answer (default: best,rrt,astar)")
          ->delimiter(',');
  app->add_option("--footsteps", selection.footsteps,
                  "check those of this folder in place of planners: NAME.csv or NAME.yaml")
      ->excludes(planners);
  app->add_option("--jobs", command->jobs, "cases at a time (default: as many as cores)")
      ->check(CLI::Range(1, 1024));
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  const auto sets = std::make_shared<std::vector<std::string>>();
  DeclareOverrides(app, "each scene's config", sets.get());
  return [command, sets] {
    command->selection.overrides = ParseOverrides(*sets);
    return Bench(*command);
  };
}

}  // namespace halfstep
