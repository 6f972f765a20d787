#include "experiments/manual/completed.h"
#include "experiments/manual/completion.h"

namespace halfstep {
namespace {

// A word for fish.
std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "'";
}

std::string Values(const CompletedOption& option, const std::string& program) {
  if (!option.list.empty()) {
    return " -a " + Quoted("(" + program + " list " + option.list + " | cut -d ' ' -f 1)");
  }
  if (!option.values.empty()) return " -f -a " + Quoted(Joined(option.values, " "));
  return "";
}

std::string LineOf(const CompletedOption& option, const std::string& when,
                   const std::string& program) {
  std::string line = when;
  for (const std::string& name : option.names) {
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (option.has_value && !option.names.empty()) line += " -r";
  if (option.has_value) line += Values(option, program);
  if (option.names.empty()) return line == when ? "" : line + "\n";
  return line + " -d " + Quoted(option.meaning) + "\n";
}

}  // namespace

std::string FishCompletion(const CLI::App& app, const std::string& program) {
  std::string text = "# Completion of " + program + " in fish; written when it is built.\n";
  const std::string complete = "complete -c " + program,
                    first = complete + " -n __fish_use_subcommand";
  for (const CompletedOption& option : CompletedOptionsOf(app)) {
    text += LineOf(option, first, program);
  }
  for (const CompletedCommand& command : CompletedCommandsOf(app)) {
    text += first + " -f -a " + command.name + " -d " + Quoted(command.meaning) + "\n";
    const std::string when = complete + " -n '__fish_seen_subcommand_from " + command.name + "'";
    for (const CompletedOption& option : command.options) text += LineOf(option, when, program);
  }
  return text;
}

}  // namespace halfstep
