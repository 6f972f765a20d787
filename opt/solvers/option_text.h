#pragma once

#include <optional>
#include <string>
#include <vector>

namespace halfstep::opt {

/// The whole text as a number; nullopt when it is not one.
std::optional<double> ParseNumber(const std::string& text);
/// The shortest text that is read back as the same number.
std::string TextOf(double value);
/// The whole text as an integer; nullopt when it is not one.
std::optional<int> ParseInteger(const std::string& text);

/// "ipopt: unknown option `tool` (valid: tol, …)": when many names are valid, only the nearest are
/// listed.
std::string UnknownOption(const std::string& solver, const std::string& option,
                          std::vector<std::string> valid);

/// "ipopt: option tol = abc was refused: …".
std::string RefusedOption(const std::string& solver, const std::string& option,
                          const std::string& value, const std::string& why);

}  // namespace halfstep::opt
