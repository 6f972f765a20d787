#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/config/experiment_config.h"
#include "experiments/tables/given_walk_file.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

// The value of smoothing.given for files that are named from the working directory.
std::string GivenGroup(const std::vector<std::string>& files) {
  const GivenWalkFiles sorted = SortGivenFiles(files);
  std::string group;
  for (const auto& [key, path] :
       {std::pair{"overlaps", sorted.overlaps}, std::pair{"half_steps", sorted.half_steps}}) {
    if (path.empty()) continue;
    const nlohmann::json absolute = fs::absolute(path).string();  // a text of JSON is one of YAML
    group += (group.empty() ? "" : ", ") + std::string(key) + ": " +
             absolute.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
  return "{" + group + "}";
}

}  // namespace

ExitStatus Smooth(const SmoothCommand& command) {
  RunCommand run = command.run;
  fs::path given(run.config);
  if (fs::is_directory(given)) {
    if (!fs::exists(given / "manifest.json") || !fs::exists(given / "config.yaml")) {
      throw InputError({run.config +
                        ": no such run folder (valid: a config, or a folder that `halfstep run` "
                        "wrote)"});
    }
    run.config = (given / "config.yaml").string();
    if (!given.has_filename()) given = given.parent_path();  // a trailing slash
    if (!run.out) run.out = given.string() + "-smooth";
  }
  if (!command.given.empty()) {
    run.overrides.push_back({"smoothing.given", GivenGroup(command.given)});
    if (std::ranges::find(run.methods, "given") == run.methods.end()) {
      run.methods.insert(run.methods.begin(), "given");
    }
  }
  if (LoadConfig(run.config, run.overrides, run.tools).has_goal) {
    throw InputError({run.config +
                      ": goal: there are no footsteps to smooth (valid: a config with "
                      "`footsteps`, or the folder of a run; `halfstep run` plans first)"});
  }
  return Run(run);
}

CommandAction DeclareSmooth(CLI::App* app, const Toolbox& tools) {
  const auto command = std::make_shared<SmoothCommand>();
  command->run.tools = tools;
  const auto sets = std::make_shared<std::vector<std::string>>();
  app->add_option("CONFIG", command->run.config,
                  "config with footsteps, a shipped one's name, or a run folder")
      ->required();
  DeclareMethods(app, &command->run);
  app->add_option(
         "--given", command->given,
         "CSV files of a walk of one's own, with columns of overlaps.csv or half_steps.csv: "
         "the method `given`")
      ->allow_extra_args(false);
  DeclareOverrides(app, "the config", sets.get());
  app->add_option("--out", command->run.out,
                  "run folder (default: as `run`; RUN-smooth of a run folder)");
  DeclareRunFlags(app, &command->run);
  return [command, sets] {
    command->run.overrides = ParseOverrides(*sets);
    return Smooth(*command);
  };
}

}  // namespace halfstep
