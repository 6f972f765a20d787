#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "experiments/commands/command_line.h"
#include "experiments/commands/command_mistake.h"
#include "experiments/commands/commands.h"
#include "experiments/config/data_folder.h"
#include "experiments/config/toolbox.h"
#include "opt/adapters/solver_registry.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

struct Entry {
  std::string name;
  std::string meaning;
  std::optional<bool> available = std::nullopt;  // of solvers only
};

std::vector<Entry> FilesOf(const std::filesystem::path& folder) {
  std::vector<Entry> entries;
  for (const std::filesystem::path& path : YamlFiles(folder)) {
    entries.push_back({path.stem().string(), path.string()});
  }
  return entries;
}

std::vector<Entry> Solvers(const Toolbox& tools) {
  std::vector<Entry> entries;
  for (const std::string& name : opt::SolverNames()) {
    const std::unique_ptr<opt::Solver> solver = opt::MakeSolver(name);
    entries.push_back(
        {name, solver->available() ? "available" : solver->WhyUnavailable(), solver->available()});
  }
  for (const auto& own : tools.methods.own_solvers())
    entries.push_back({own->name(), "available", true});
  return entries;
}

std::vector<Entry> Entries(const std::string& what, const Toolbox& tools) {
  if (what == "robots") return FilesOf(RobotsFolder());
  if (what == "scenes") return FilesOf(ScenesFolder());
  for (const char* folder : {"configs", "episodes", "sweeps"}) {
    if (what == folder) return FilesOf(DataFolder() / folder);
  }
  if (what == "solvers") return Solvers(tools);
  std::vector<Entry> entries;
  if (what == "planners") {
    for (const NamedPlanner& planner : tools.planners.all()) {
      entries.push_back({planner.name, planner.meaning});
    }
    return entries;
  }
  for (const auto& smoother : tools.methods.all()) {
    entries.push_back({smoother->name(), smoother->meaning()});
  }
  return entries;
}

}  // namespace

ExitStatus List(const std::string& what, bool json, const Toolbox& tools) {
  const std::vector<Entry> entries = Entries(what, tools);
  if (json) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Entry& entry : entries) {
      list.push_back({{"name", entry.name}, {"meaning", entry.meaning}});
      if (entry.available) list.back()["available"] = *entry.available;
    }
    std::cout << list.dump(2) << '\n';
    return kSuccess;
  }
  size_t width = 0;
  for (const Entry& entry : entries) width = std::max(width, entry.name.size());
  for (const Entry& entry : entries) {
    std::cout << entry.name << std::string(width + 2 - entry.name.size(), ' ') << entry.meaning
              << '\n';
  }
  return kSuccess;
}

CommandAction DeclareList(CLI::App* app, const Toolbox& tools) {
  struct Options {
    std::string what, config;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  app->add_option("WHAT", options->what,
                  "robots, scenes, configs, episodes, sweeps, solvers, methods, planners or "
                  "half-steps")
      ->required()
      ->check(OneOf({"robots", "scenes", "configs", "episodes", "sweeps", "solvers", "methods",
                     "planners", "half-steps"}));
  app->add_option("CONFIG", options->config, "whose half-steps (half-steps only)");
  app->add_flag("--json", options->json, "print JSON");
  return [options, tools] {
    if (options->what != "half-steps") return List(options->what, options->json, tools);
    if (options->config.empty()) {
      throw InputError({"list half-steps: of which config? (valid: a YAML file)"});
    }
    return ListHalfSteps(
        {.config = options->config, .overrides = {}, .json = options->json, .tools = tools});
  };
}

}  // namespace halfstep
