#include "wpg/files/suggestion.h"

#include <algorithm>

#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep {

std::string DidYouMean(const std::string& word, const std::vector<std::string>& choices) {
  const std::string nearest = NearestWord(word, choices);
  return nearest.empty() ? "" : "did you mean " + Quote(nearest) + "? ";
}

// A robot may have thousands of links; a reader takes in a few dozen names.
std::string Joined(const std::vector<std::string>& words) {
  constexpr size_t kMost = 40;
  std::string text;
  for (size_t i = 0; i < std::min(words.size(), kMost); ++i) {
    text += (text.empty() ? "" : ", ") + words[i];
  }
  if (words.size() > kMost) text += " and " + std::to_string(words.size() - kMost) + " more";
  return text;
}

std::string Suggestion(const std::string& word, const std::vector<std::string>& choices) {
  return " (" + DidYouMean(word, choices) +
         "valid: " + (choices.empty() ? "none" : Joined(choices)) + ")";
}

}  // namespace halfstep
