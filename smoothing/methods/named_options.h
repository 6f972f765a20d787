#pragma once

#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "wpg/files/fields.h"

namespace halfstep {

/// An option of a method that has no C++ type for its options.
struct NamedOption {
  std::string name;                                       ///< its key
  std::string meaning, unit;                              ///< as in NumberSpec
  double min = -std::numeric_limits<double>::infinity();  ///< of numbers: smallest valid value
  double max = std::numeric_limits<double>::infinity();   ///< of numbers: largest valid value
  std::vector<std::string> choices;                       ///< of texts; empty: any
  std::variant<bool, int, double, std::string> value;     ///< the default, or what a config says
};
/// For an OptionGroup whose defaults they are.
using NamedOptions = std::vector<NamedOption>;

/// Declares each by its name and the type of its value.
void DeclareFields(Fields& fields, NamedOptions* options);

}  // namespace halfstep
