#include "opt/solvers/option_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <system_error>

namespace halfstep::opt {
namespace {

/// Levenshtein's number of single-letter edits.
size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

}  // namespace

std::string TextOf(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::optional<double> ParseNumber(const std::string& text) {
  const bool has_plus = text.starts_with('+') && !text.starts_with("+-");
  const char *const begin = text.data() + (has_plus ? 1 : 0), *const end =
                                                                  text.data() + text.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || std::isnan(value)) return std::nullopt;
  return value;
}

std::optional<int> ParseInteger(const std::string& text) {
  const std::optional<double> value = ParseNumber(text);
  if (!value || *value != std::floor(*value)) return std::nullopt;
  if (std::abs(*value) > std::numeric_limits<int>::max()) return std::nullopt;
  return static_cast<int>(*value);
}

std::string UnknownOption(const std::string& solver, const std::string& option,
                          std::vector<std::string> valid) {
  constexpr size_t kMostTold = 12;
  const bool all = valid.size() <= kMostTold;
  if (!all) {
    std::stable_sort(valid.begin(), valid.end(), [&](const auto& a, const auto& b) {
      return EditDistance(a, option) < EditDistance(b, option);
    });
    valid.resize(5);
  }
  std::string text = solver + ": unknown option `" + option + (all ? "` (valid: " : "` (nearest: ");
  for (size_t i = 0; i < valid.size(); ++i) text += (i > 0 ? ", " : "") + valid[i];
  return text + ").";
}

std::string RefusedOption(const std::string& solver, const std::string& option,
                          const std::string& value, const std::string& why) {
  return solver + ": option " + option + " = " + value + " was refused: " + why + ".";
}

}  // namespace halfstep::opt
