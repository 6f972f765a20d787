#pragma once

#include <string>
#include <vector>

namespace halfstep {

// Patterns as std::regex has them (ECMAScript): whoever includes that compiles all of it.

/// Where a pattern is found in a text.
struct PatternMatch {
  std::string before;               ///< it
  std::vector<std::string> groups;  ///< [0] is the whole match; empty: the pattern is not found
  std::string after;                ///< it

  explicit operator bool() const { return !groups.empty(); }
  const std::string& operator[](size_t group) const { return groups.at(group); }
};

/// The first match.
PatternMatch FirstMatch(const std::string& text, const std::string& pattern);
/// The groups of every match, in their order.
std::vector<std::vector<std::string>> AllMatches(const std::string& text,
                                                 const std::string& pattern);
/// The text with every match replaced; `by` has groups as $1.
std::string AllReplaced(const std::string& text, const std::string& pattern, const std::string& by);

}  // namespace halfstep
