#include "wpg/files/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <system_error>

#include "wpg/check.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

bool SpellsNotFinite(std::string_view unsigned_text) {
  std::string lower(unsigned_text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  for (const char* word : {"nan", ".nan", "inf", ".inf", "infinity"}) {
    if (lower == word) return true;
  }
  return false;
}

template <typename Real>
std::string ShortestOf(Real value) {
  std::array<char, 64> buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  HALFSTEP_CHECK(error == std::errc(), "a number of more than 64 characters");
  return {buffer.data(), end};
}

}  // namespace

NumberText ParseNumber(std::string_view text) {
  NumberText number;
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  if (SpellsNotFinite(text)) {
    number.kind = NumberText::Kind::kNotFinite;
    return number;
  }
  // from_chars alone would also take a second sign, "inf" and "nan".
  if (text.empty() || !(IsDigit(text[0]) || text[0] == '.')) return number;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number.value);
  if (error == std::errc::invalid_argument || stop != end) return number;
  if (text.size() > 1 && text[0] == '0' && IsDigit(text[1])) {
    number.kind = NumberText::Kind::kLeadingZero;
    return number;
  }
  if (error != std::errc()) {
    number.kind = NumberText::Kind::kNotFinite;
    return number;
  }
  number.kind = NumberText::Kind::kNumber;
  if (std::from_chars(text.data(), end, number.extended).ec != std::errc()) {
    number.extended = number.value;
  }
  if (negative) {
    number.value = -number.value;
    number.extended = -number.extended;
  }
  return number;
}

std::string PointNeeded(std::string_view text) {
  std::string pointed(text);
  std::replace(pointed.begin(), pointed.end(), ',', '.');
  if (pointed == text || ParseNumber(pointed).kind != NumberText::Kind::kNumber) return "";
  return "a decimal point is needed: " + pointed + "?";
}

std::string NumberMistake(std::string_view text) {
  const std::string quoted = Quote(text), hint = PointNeeded(text);
  switch (ParseNumber(text).kind) {
    case NumberText::Kind::kNotFinite:
      return quoted + " is not a finite number";
    case NumberText::Kind::kLeadingZero:
      return quoted + " is not a decimal number (leading zero)";
    default:
      return quoted + " is not a number" + (hint.empty() ? "" : " (" + hint + ")");
  }
}

std::string ShortestText(double value) {
  HALFSTEP_CHECK(std::isfinite(value), "value = " << value);
  return ShortestOf(value);
}

double Shortened(double value, int digits) {
  std::array<char, 64> text;
  const char* const end = std::to_chars(text.data(), text.data() + text.size(), value,
                                        std::chars_format::scientific, digits - 1)
                              .ptr;
  (void)std::from_chars(text.data(), end, value);
  return value;
}

double DegreesToRadians(long double degrees) {
  return static_cast<double>(degrees * std::numbers::pi_v<long double> / 180.0L);
}

std::string ShortestDegrees(double radians) {
  HALFSTEP_CHECK(std::isfinite(radians), "radians = " << radians);
  const auto reads_back = [radians](const std::string& text) {
    const NumberText number = ParseNumber(text);
    return number.kind == NumberText::Kind::kNumber && DegreesToRadians(number.extended) == radians;
  };
  // The map to radians is not onto when degrees are doubles: some radians need the extended form.
  const long double exact =
      static_cast<long double>(radians) * 180.0L / std::numbers::pi_v<long double>;
  std::string shortest = ShortestOf(exact);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double nearest = static_cast<double>(exact);
  for (const double degrees :
       {nearest, std::nextafter(nearest, -kInfinity), std::nextafter(nearest, kInfinity)}) {
    const std::string text = std::isfinite(degrees) ? ShortestOf(degrees) : shortest;
    if (text.size() < shortest.size() && reads_back(text)) shortest = text;
  }
  HALFSTEP_CHECK(reads_back(shortest), "radians = " << radians << ", degrees " << shortest);
  return shortest;
}

}  // namespace halfstep
