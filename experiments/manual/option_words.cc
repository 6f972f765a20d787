#include "experiments/manual/option_words.h"

#include <functional>
#include <string_view>

namespace halfstep {
namespace {

// The text between the first { and the } behind it, with both; "" where there is none.
std::string Braced(const std::string& type) {
  const size_t begin = type.find('{'), end = type.find('}', begin);
  return end == std::string::npos ? "" : type.substr(begin, end + 1 - begin);
}

}  // namespace

std::vector<const CLI::App*> CommandsOf(const CLI::App& app) {
  const std::vector<const CLI::App*> all =
      app.get_subcommands(std::function<bool(const CLI::App*)>());
  return all;
}

std::vector<std::string> NamesOf(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::string ValueOf(const CLI::Option& option) {
  const bool several = option.get_items_expected_max() > 1;
  if (option.get_positional()) return option.get_name(true) + (several ? "…" : "");
  if (option.get_items_expected_max() == 0) return "";
  const std::string type = option.get_type_name(), choices = Braced(type);
  if (!choices.empty()) return choices;
  return type.substr(0, type.find_first_of(": ")) + (several ? "…" : "");
}

std::vector<std::string> ChoicesOf(const CLI::Option& option) {
  constexpr std::string_view kBetween = "{, }";
  const std::string text = Braced(option.get_type_name());
  std::vector<std::string> choices;
  for (size_t begin = text.find_first_not_of(kBetween); begin != std::string::npos;) {
    const size_t end = text.find_first_of(kBetween, begin);
    choices.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(kBetween, end);
  }
  return choices;
}

}  // namespace halfstep
