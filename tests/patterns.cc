#include "tests/patterns.h"

#include <regex>

namespace halfstep {

PatternMatch FirstMatch(const std::string& text, const std::string& pattern) {
  PatternMatch match;
  std::smatch found;
  if (std::regex_search(text, found, std::regex(pattern))) {
    match = {.before = found.prefix().str(), .groups = {}, .after = found.suffix().str()};
    for (const auto& group : found) match.groups.push_back(group.str());
  }
  return match;
}

std::vector<std::vector<std::string>> AllMatches(const std::string& text,
                                                 const std::string& pattern) {
  std::vector<std::vector<std::string>> all;
  for (PatternMatch match = FirstMatch(text, pattern); match;
       match = FirstMatch(match.after, pattern)) {
    all.push_back(match.groups);
  }
  return all;
}

std::string AllReplaced(const std::string& text, const std::string& pattern,
                        const std::string& by) {
  return std::regex_replace(text, std::regex(pattern), by);
}

}  // namespace halfstep
