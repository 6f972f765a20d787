#pragma once

#include <string>
#include <string_view>

namespace halfstep {

/// What a text says about a number; `value` and `extended` are meaningful for kNumber only.
struct NumberText {
  /// What the text is.
  enum class Kind {
    kNumber,
    kNotANumber,   ///< also hexadecimal, octal 0o17, 1_000, 12:30.
    kNotFinite,    ///< nan, inf in YAML's and C's spellings, or beyond the range of a double.
    kLeadingZero,  ///< 010: octal for some readers, decimal for others.
  };
  Kind kind = Kind::kNotANumber;  ///< what it is
  double value = 0.0;             ///< nearest double, finite.
  long double extended = 0.0;     ///< the same in extended precision, for a change of unit.
};

/// Reads a decimal number, whole text, with an optional sign: 12, -0.5, .5, 5., +1e-3.
NumberText ParseNumber(std::string_view text);

/// What to say of a number with a decimal comma: "a decimal point is needed: 0.5?" for 0,5; ""
/// where a point in place of the comma makes no number.
std::string PointNeeded(std::string_view text);

/// What is wrong with a text as a number: "'0,5' is not a number (a decimal point …)".
/// Precondition: ParseNumber finds no number in it.
std::string NumberMistake(std::string_view text);

/// Shortest decimal text that reads back to the same double. Precondition: finite.
std::string ShortestText(double value);

/// The double whose shortest decimal form has at most `digits` significant digits, nearest to the
/// value.
double Shortened(double value, int digits = 5);

/// Whether a key's number is written in degrees and stored in radians.
inline bool IsDegrees(std::string_view key) { return key.ends_with("_deg"); }

/// Radians, correctly rounded but for one case in about 10³, of a number of degrees.
double DegreesToRadians(long double degrees);
/// The shortest text of degrees found that DegreesToRadians(ParseNumber(text).extended) takes back
/// to the same double: 30 for the double nearest to π/6. Precondition: finite,
/// less than 1e300 in size.
std::string ShortestDegrees(double radians);

}  // namespace halfstep
