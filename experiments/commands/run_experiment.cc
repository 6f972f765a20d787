#include "experiments/commands/run_experiment.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "experiments/build_info.h"
#include "experiments/commands/command_line.h"
#include "experiments/commands/printable_stream.h"
#include "experiments/run/exit_status.h"
#include "wpg/files/input_error.h"
#include "wpg/files/leftovers.h"
#include "wpg/files/text.h"

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

// What is wrong with the first word of a command line, when it is meant for a command and is none;
// "": nothing.
std::string CommandMistake(int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return "";
  const std::string word = argv[1];
  std::vector<std::string> names;
  std::string valid;
  for (const CommandEntry& entry : CommandEntries()) {
    if (word == entry.name) return "";
    names.emplace_back(entry.name);
    valid += (valid.empty() ? "" : ", ") + names.back();
  }
  const std::string near = NearestWord(word, names);
  return Quote(word) + ": no such command (" +
         (near.empty() ? "" : "did you mean " + Quote(near) + "? ") + "valid: " + valid +
         "; `halfstep -h` explains)";
}

}  // namespace

int RunExperiment(int argc, char** argv) {
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
    commands.emplace_back(command, entry.declare(command));
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  }
  if (const std::string mistake = CommandMistake(argc, argv); !mistake.empty()) {
    std::cerr << "halfstep: " << mistake << '\n';
    return kBadInput;
  }
  try {
    app.parse(argc, argv);
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
