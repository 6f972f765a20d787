#include "experiments/manual/completion.h"

#include <array>

#include "experiments/manual/option_words.h"

namespace halfstep {
namespace {

std::string Spaced(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

// What values of options and arguments are names of, as `halfstep list` prints them first.
struct Listed {
  const char* name;
  const char* list;
};
constexpr std::array kListed = {Listed{"--robot", "robots"}, Listed{"--method", "methods"},
                                Listed{"CONFIG", "configs"}};

std::string WordsOf(const CLI::App& command) {
  std::vector<std::string> names;
  std::string choices, of_arguments;
  for (const CLI::Option* option : command.get_options()) {
    const std::vector<std::string> ones = NamesOf(*option);
    names.insert(names.end(), ones.begin(), ones.end());
    const std::string typed = ones.empty() ? option->get_name(true) : ones.back();
    std::string values = Spaced(ChoicesOf(*option));
    for (const Listed& listed : kListed) {
      if (typed == listed.name) values = std::string("$(listed ") + listed.list + ")";
    }
    if (values.empty()) continue;
    const std::string chosen = ") choices=\"" + values + "\" ;;\n";
    (ones.empty() ? of_arguments : choices) += "        " + (ones.empty() ? "*" : typed) + chosen;
  }
  choices += of_arguments;
  std::string text = "    " + command.get_name() + ")\n      options=\"" + Spaced(names) + "\"\n";
  if (!choices.empty()) text += "      case \"$before\" in\n" + choices + "      esac\n";
  return text + "      ;;\n";
}

}  // namespace

std::string BashCompletion(const CLI::App& app, const std::string& program) {
  std::vector<std::string> names;
  std::string cases;
  for (const CLI::App* command : CommandsOf(app)) {
    names.push_back(command->get_name());
    cases += WordsOf(*command);
  }
  for (const CLI::Option* option : app.get_options()) names.push_back(NamesOf(*option).back());
  return "# Completion of " + program + " in bash; written when it is built.\n_" + program +
         R"(() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} options="" choices=""
  listed() { "${COMP_WORDS[0]}" list "$1" 2>/dev/null | cut -d " " -f 1; }
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W ")" +
         Spaced(names) + R"(" -- "$word"))
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
