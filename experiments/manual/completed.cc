#include "experiments/manual/completed.h"

#include <array>

#include "experiments/manual/option_words.h"

namespace halfstep {
namespace {

// What values of options and arguments are names of, as `halfstep list` prints them first.
struct Listed {
  const char* command;  // "": any
  const char* name;
  const char* list;
};
constexpr std::array kListed = {Listed{"live", "CONFIG", "episodes"},
                                Listed{"", "CONFIG", "configs"}, Listed{"", "SWEEP", "sweeps"},
                                Listed{"", "--robot", "robots"}, Listed{"", "--method", "methods"}};

std::string ListOf(const std::string& command, const std::string& typed) {
  for (const Listed& listed : kListed) {
    if (typed != listed.name) continue;
    if (*listed.command == '\0' || command == listed.command) return listed.list;
  }
  return "";
}

std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

std::vector<CompletedOption> CompletedOptionsOf(const CLI::App& app) {
  std::vector<CompletedOption> all;
  for (const CLI::Option* option : app.get_options()) {
    CompletedOption one{.names = NamesOf(*option),
                        .meaning = FirstLine(option->get_description()),
                        .has_value = !ValueOf(*option).empty(),
                        .values = ChoicesOf(*option),
                        .list = ""};
    const std::string typed = one.names.empty() ? option->get_name(true) : one.names.back();
    one.list = ListOf(app.get_name(), typed);
    all.push_back(std::move(one));
  }
  return all;
}

std::vector<CompletedCommand> CompletedCommandsOf(const CLI::App& app) {
  std::vector<CompletedCommand> all;
  for (const CLI::App* command : CommandsOf(app)) {
    all.push_back(
        {command->get_name(), FirstLine(command->get_description()), CompletedOptionsOf(*command)});
  }
  return all;
}

std::string Joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

}  // namespace halfstep
