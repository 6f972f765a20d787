#include "wpg/files/input_error.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace halfstep {
namespace {

std::string Lines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) {
    if (!text.empty()) text += '\n';
    text += line;
  }
  return text;
}

// Optimal-string-alignment distance: insertions, deletions, substitutions and swaps of neighbours
// cost 1 each. Source: [Damerau1964], in its restricted form (no substring edited twice).
size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t substitution = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, substitution});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
    std::swap(before_last, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

InputError::InputError(std::vector<std::string> complaints)
    : std::runtime_error(Lines(complaints)), complaints_(std::move(complaints)) {}

void Complaints::Add(const std::string& file, int line, int column, const std::string& key,
                     const std::string& what) {
  std::string text = file;
  if (line > 0) text += ":" + std::to_string(line);
  if (line > 0 && column > 0) text += ":" + std::to_string(column);
  if (!text.empty()) text += ": ";
  if (!key.empty()) text += key + ": ";
  lines_.push_back(text + what);
}

void Complaints::ThrowIfAny() const {
  if (!empty()) throw InputError(lines_);
}

std::string NearestWord(const std::string& word, const std::vector<std::string>& choices) {
  constexpr size_t kLongest = 64;
  if (word.size() > kLongest) return "";
  std::string nearest;
  size_t nearest_distance = 0;
  for (const std::string& choice : choices) {
    if (choice.size() > kLongest) continue;
    const size_t slips_allowed = std::max(word.size(), choice.size()) / 3;
    const size_t distance = EditDistance(word, choice);
    if (distance <= slips_allowed && (nearest.empty() || distance < nearest_distance)) {
      nearest = choice;
      nearest_distance = distance;
    }
  }
  return nearest;
}

}  // namespace halfstep
