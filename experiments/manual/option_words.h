#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace halfstep {

/// The commands of a program in the order in which they were added.
std::vector<const CLI::App*> CommandsOf(const CLI::App& app);

/// The names of an option as they are typed, `-h` before `--help`; none of a positional argument.
std::vector<std::string> NamesOf(const CLI::Option& option);

/// What stands for the option's value: its kind in capitals ("FLOAT"), its choices ("{4,8}"), a
/// positional argument's name; with "…" where there may be several. "" for a flag.
std::string ValueOf(const CLI::Option& option);

/// The choices of the option's value, as OneOf (command_mistake.h) tells them; none: it is free.
std::vector<std::string> ChoicesOf(const CLI::Option& option);

}  // namespace halfstep
