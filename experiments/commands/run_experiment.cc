#include "experiments/commands/run_experiment.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

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

std::string MistakeOf(const CLI::ParseError& error, const CLI::App& command) {
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) return OptionMistake(command);
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) return MissingWord(command);
  return "";
}

}  // namespace

int RunExperiment(int argc, char** argv, const Toolbox& tools) {
  RemoveLeftoversAtSignals();
  const PrintableStream out(&std::cout), err(&std::cerr);
  CLI::App app;
  if (argc > 0) app.name(std::filesystem::path(argv[0]).filename().string());
  const std::vector<DeclaredCommand> commands = DeclareProgram(&app, tools);
  if (const std::string mistake = CommandMistake(argc, argv); !mistake.empty()) {
    std::cerr << "halfstep: " << mistake << '\n';
    return kBadInput;
  }
  try {
    const PlainLocale plain;  // CLI11 reads numbers by strtold
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    for (const auto& [command, action] : commands) {
      const std::string mistake = *command ? MistakeOf(error, *command) : "";
      if (mistake.empty()) continue;
      std::cerr << "halfstep: " << command->get_name() << ": " << mistake << '\n';
      return kBadInput;
    }
    return app.exit(error) == 0 ? kSuccess : kBadInput;
  }
  for (const auto& [command, action] : commands) {
    if (*command) return RunAction(action);
  }
  std::string names;
  for (const auto& [command, action] : commands) {
    names += (names.empty() ? "" : ", ") + command->get_name();
  }
  std::cerr << "halfstep: which command? (valid: " << names << "; `halfstep -h` explains)\n";
  return kBadInput;
}

}  // namespace halfstep
