#include "experiments/manual/completion.h"

#include "experiments/manual/completed.h"

namespace halfstep {
namespace {

std::string WordsOf(const CompletedCommand& command) {
  std::vector<std::string> names;
  std::string choices, of_arguments;
  for (const CompletedOption& option : command.options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
    const std::string values =
        option.list.empty() ? Joined(option.values, " ") : "$(listed " + option.list + ")";
    if (values.empty()) continue;
    const bool is_argument = option.names.empty();
    (is_argument ? of_arguments : choices) += "        " +
                                              (is_argument ? "*" : option.names.back()) +
                                              ") choices=\"" + values + "\" ;;\n";
  }
  choices += of_arguments;
  std::string text = "    " + command.name + ")\n      options=\"" + Joined(names, " ") + "\"\n";
  if (!choices.empty()) text += "      case \"$before\" in\n" + choices + "      esac\n";
  return text + "      ;;\n";
}

}  // namespace

std::string BashCompletion(const CLI::App& app, const std::string& program) {
  std::vector<std::string> names;
  std::string cases;
  for (const CompletedCommand& command : CompletedCommandsOf(app)) {
    names.push_back(command.name);
    cases += WordsOf(command);
  }
  for (const CompletedOption& option : CompletedOptionsOf(app)) {
    names.push_back(option.names.back());
  }
  return "# Completion of " + program + " in bash; written when it is built.\n_" + program +
         R"(() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} options="" choices=""
  listed() { "${COMP_WORDS[0]}" list "$1" 2>/dev/null | cut -d " " -f 1; }
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W ")" +
         Joined(names, " ") + R"(" -- "$word"))
    return
  fi
  case "${COMP_WORDS[1]}" in
)" + cases +
         R"(  esac
  case "$word" in
    -*) COMPREPLY=($(compgen -W "$options" -- "$word")) ;;
    *) COMPREPLY=($(compgen -W "$choices" -- "$word") $(compgen -f -- "$word")) ;;
  esac
}
complete -o filenames -F _)" +
         program + " " + program + "\n";
}

}  // namespace halfstep
