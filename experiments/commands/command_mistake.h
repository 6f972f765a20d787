#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace halfstep {

/// What is wrong with the first word of a command line, when it is meant for a command and is none;
/// "": nothing.
std::string CommandMistake(int argc, char** argv);

/// What is wrong with the words of a command's line that it did not take, with the nearest of its
/// options; "": it took them all.
std::string OptionMistake(const CLI::App& command);

/// Which word a command's line lacks, with what it is; "": none.
std::string MissingWord(const CLI::App& command);

/// The value of an option that must be one of some words. Refuses another with the nearest of them.
CLI::Validator OneOf(const std::vector<std::string>& choices);

/// Lets the options of a command that are numbers refuse decimal commas with the number that was
/// meant, before anything else is said of them.
void RefuseDecimalCommas(CLI::App* command);

}  // namespace halfstep
