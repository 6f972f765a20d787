#include "wpg/files/suggestion.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep {

namespace {

std::string Lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

bool IsMeant(const std::string& choice, const std::string& word) {
  return Lower(choice) == Lower(word) || choice.ends_with("/" + word) || choice == word + ".yaml";
}

}  // namespace

std::string DidYouMean(const std::string& word, const std::vector<std::string>& choices) {
  const auto meant = std::ranges::find_if(
      choices, [&word](const std::string& choice) { return IsMeant(choice, word); });
  const std::string nearest = meant != choices.end() ? *meant : NearestWord(word, choices);
  return nearest.empty() ? "" : "did you mean " + Quote(nearest) + "? ";
}

std::string DidYouMeanRun(const std::string& folder) {
  const std::filesystem::path run = std::filesystem::path("runs") / folder;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(run / "manifest.json", ignored)) return "";
  return "did you mean " + Quote(run.string()) + "? ";
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
