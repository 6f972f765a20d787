#include "experiments/manual/completed.h"
#include "experiments/manual/completion.h"
#include "experiments/manual/option_words.h"

namespace halfstep {
namespace {

// In single quotes, with a backslash before what would end a part of a specification.
std::string Specified(const std::string& text, const std::string& ends) {
  std::string quoted;
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      if (ends.find(c) != std::string::npos) quoted += '\\';
      quoted += c;
    }
  }
  return quoted;
}

// ":what it is:how it is completed".
std::string ValueSpecification(const CompletedOption& option, const std::string& program) {
  if (!option.list.empty()) {
    return ":" + option.list + ":{ _" + program + "_listed " + option.list + "; _files }";
  }
  if (!option.values.empty()) return ":value:(" + Joined(option.values, " ") + ")";
  return ":value:_files";
}

// The words of _arguments for an option or an argument; all may be given again.
std::string Specifications(const CompletedOption& option, const std::string& program) {
  std::string value = option.has_value ? ValueSpecification(option, program) : "";
  if (option.names.empty()) return " '*" + value + "'";
  std::string text;
  for (const std::string& name : option.names) {
    text += " \\\n        '*" + name + "[" + Specified(option.meaning, "[]:\\") + "]" + value + "'";
  }
  return text;
}

std::string CaseOf(const CompletedCommand& command, const std::string& program) {
  std::string text = "    " + command.name + ")\n      _arguments -S";
  const CompletedOption* argument = nullptr;
  for (const CompletedOption& option : command.options) {
    if (!option.names.empty()) text += Specifications(option, program);
    if (option.names.empty() && argument == nullptr) argument = &option;
  }
  if (argument != nullptr) text += " \\\n       " + Specifications(*argument, program);
  return text + " ;;\n";
}

}  // namespace

std::string ZshCompletion(const CLI::App& app, const std::string& program) {
  std::string commands, cases;
  for (const CompletedCommand& command : CompletedCommandsOf(app)) {
    commands += "    '" + command.name + ":" + Specified(command.meaning, "") + "'\n";
    cases += CaseOf(command, program);
  }
  for (const CompletedOption& option : CompletedOptionsOf(app)) {
    commands += "    '" + option.names.back() + ":" + Specified(option.meaning, "") + "'\n";
  }
  return "#compdef " + program + "\n# Completion of " + program +
         " in zsh; written when it is built.\n\n_" + program +
         "_listed() {\n  compadd -- ${(f)\"$(" + program +
         " list $1 2>/dev/null | cut -d ' ' -f 1)\"}\n}\n\n_" + program +
         "() {\n  if (( CURRENT == 2 )); then\n    local -a commands=(\n" + commands +
         "    )\n    _describe command commands\n    return\n  fi\n  shift words\n  (( CURRENT-- "
         "))\n"
         "  case $words[1] in\n" +
         cases + "    *) _files ;;\n  esac\n}\n\n_" + program + " \"$@\"\n";
}

}  // namespace halfstep
