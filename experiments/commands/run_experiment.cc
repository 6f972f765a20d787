#include "experiments/commands/run_experiment.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "experiments/about/build_info.h"
#include "experiments/commands/command_line.h"
#include "experiments/commands/command_mistake.h"
#include "experiments/commands/printable_stream.h"
#include "experiments/run/exit_status.h"
#include "wpg/files/input_error.h"
#include "wpg/files/leftovers.h"
#include "wpg/files/plain_locale.h"

namespace halfstep {
namespace {

int RunAction(const CommandAction& action) {
  try {
    const int status = action();
    if (!std::cout.flush()) throw std::runtime_error("standard output cannot be written");
    return status;
  } catch (const InputError& error) {
    for (const std::string& complaint : error.complaints()) std::cerr << complaint << '\n';
    return kBadInput;
  } catch (const std::bad_alloc&) {
    std::cerr << "halfstep: out of memory (smaller input, a coarser period or fewer obstacles)\n";
    return kFailed;
  } catch (const std::exception& error) {
    std::cerr << "halfstep: " << error.what() << '\n';
    return kFailed;
  }
}

}  // namespace

int RunExperiment(int argc, char** argv, const Toolbox& tools) {
  RemoveLeftoversAtSignals();
  const PrintableStream out(&std::cout), err(&std::cerr);
  CLI::App app{
      "Plans and smooths humanoid walks made of half-steps.\n\n"
      "  example: halfstep run experiments/configs/bar_8cm.yaml"};
  app.set_version_flag("--version", std::string(kVersion) + " (" + std::string(kCommit) + ")");
  app.require_subcommand(0, 1);  // none at all is told below, so that a misspelt one is named
  std::vector<std::pair<CLI::App*, CommandAction>> commands;
  std::string names;
  for (const CommandEntry& entry : CommandEntries()) {
    CLI::App* const command = app.add_subcommand(entry.name, entry.help);
    commands.emplace_back(command, entry.declare(command, tools));
    RefuseDecimalCommas(command);
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  }
  if (const std::string mistake = CommandMistake(argc, argv); !mistake.empty()) {
    std::cerr << "halfstep: " << mistake << '\n';
    return kBadInput;
  }
  try {
    const PlainLocale plain;  // CLI11 reads numbers by strtold
    app.parse(argc, argv);
  } catch (const CLI::ExtrasError& error) {
    for (const auto& [command, action] : commands) {
      const std::string mistake = *command ? OptionMistake(*command) : "";
      if (mistake.empty()) continue;
      std::cerr << "halfstep: " << command->get_name() << ": " << mistake << '\n';
      return kBadInput;
    }
    return app.exit(error) == 0 ? kSuccess : kBadInput;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kSuccess : kBadInput;
  }
  for (const auto& [command, action] : commands) {
    if (*command) return RunAction(action);
  }
  std::cerr << "halfstep: which command? (valid: " << names << "; `halfstep -h` explains)\n";
  return kBadInput;
}

}  // namespace halfstep
