#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace halfstep {

/// An option or an argument as a shell completes it.
struct CompletedOption {
  std::vector<std::string> names;   ///< as they are typed, `-h` before `--help`; none: an argument
  std::string meaning;              ///< the first line of what -h says
  bool has_value = false;           ///< always true of an argument
  std::vector<std::string> values;  ///< its choices; none: it is free, a file perhaps
  std::string list;  ///< what `halfstep list` has its values under, "configs"; "": nothing
};

/// A command as a shell completes it.
struct CompletedCommand {
  std::string name;                      ///< "run"
  std::string meaning;                   ///< the first line of what -h says
  std::vector<CompletedOption> options;  ///< and arguments
};

/// The options of a program, or of one of its commands.
std::vector<CompletedOption> CompletedOptionsOf(const CLI::App& app);
/// The commands of a program, in the order in which they were added.
std::vector<CompletedCommand> CompletedCommandsOf(const CLI::App& app);

/// The words with `between` in between.
std::string Joined(const std::vector<std::string>& words, const std::string& between);

}  // namespace halfstep
