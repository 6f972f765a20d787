#include "experiments/commands/command_mistake.h"

#include "experiments/commands/command_line.h"
#include "wpg/files/number_text.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"

namespace halfstep {

std::string CommandMistake(int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return "";
  const std::string word = argv[1];
  std::vector<std::string> names;
  for (const CommandEntry& entry : CommandEntries()) {
    if (word == entry.name) return "";
    names.emplace_back(entry.name);
  }
  return Quote(word) + ": no such command (" + DidYouMean(word, names) + "valid: " + Joined(names) +
         "; `halfstep -h` explains)";
}

std::string OptionMistake(const CLI::App& command) {
  const std::vector<std::string> words = command.remaining();
  if (words.empty()) return "";
  const std::string help = "`halfstep " + command.get_name() + " -h` explains";
  // A misspelt option leaves its value behind, too: the option is what is wrong.
  const auto option = std::ranges::find_if(words, [](auto& word) { return word.starts_with("-"); });
  if (option == words.end()) return Quote(words.front()) + ": one argument too many (" + help + ")";
  std::vector<std::string> names;
  for (const CLI::Option* known : command.get_options()) {
    for (const std::string& name : known->get_lnames()) names.push_back("--" + name);
  }
  const std::string name = option->substr(0, option->find('='));
  return Quote(name) + ": no such option (" + DidYouMean(name, names) + "valid: " + Joined(names) +
         "; " + help + ")";
}

std::string MissingWord(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_required() || option->count() > 0) continue;
    return option->get_name() + " is missing: " + option->get_description() + " (`halfstep " +
           command.get_name() + " -h` explains)";
  }
  return "";
}

CLI::Validator OneOf(const std::vector<std::string>& choices) {
  return CLI::Validator(
      [choices](const std::string& word) {
        if (std::ranges::find(choices, word) != choices.end()) return std::string();
        return Quote(word) + " is none of the choices" + Suggestion(word, choices);
      },
      "{" + Joined(choices) + "}");
}

void RefuseDecimalCommas(CLI::App* command) {
  const CLI::Validator commas(
      [](const std::string& word) {
        const std::string hint = PointNeeded(word);
        return hint.empty() ? hint : Quote(word) + " is not a number (" + hint + ")";
      },
      "");
  for (CLI::Option* option : command->get_options()) {
    if (option->get_type_name().starts_with("FLOAT")) option->transform(commas);
  }
}

}  // namespace halfstep
