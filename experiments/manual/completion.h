#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace halfstep {

// Completion of a program's command line: commands, their options, the choices of options that have
// some, and the names of shipped configs, robots and methods, for which the program is asked; else
// files. `program`: as it is typed.

std::string BashCompletion(const CLI::App& app, const std::string& program);  ///< in bash
/// In zsh, with what commands and options mean.
std::string ZshCompletion(const CLI::App& app, const std::string& program);
/// In fish, the same.
std::string FishCompletion(const CLI::App& app, const std::string& program);

}  // namespace halfstep
