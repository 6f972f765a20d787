#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "wpg/files/fields.h"

namespace halfstep {

/// What a declaration says about one key. Texts are as a file has them; bounds of a key in `_deg`
/// are in degrees.
struct KeyDescription {
  /// What a key holds.
  enum class Kind {
    kNumber,
    kOptionalNumber,  ///< a number or `none`
    kInteger,
    kBoolean,
    kText,
    kTexts,
    kNumbers,
    kPoints,
    kGroup,
    kList  ///< of maps
  };
  Kind kind = Kind::kGroup;   ///< of this key
  std::string path;           ///< from the root of the document, list items as N: "footsteps.N.x_m"
  std::string meaning, unit;  ///< as in NumberSpec
  bool required = false;      ///< whether it may not be left out
  std::string default_text;   ///< YAML; "" when required, and of maps
  std::string otherwise;      ///< in place of the default: what holds when the key is absent
  double min = 0.0, max = 0.0;          ///< of numbers
  size_t min_items = 0, max_items = 0;  ///< of lists
  std::vector<std::string> choices{};   ///< of texts; empty: any
  std::string listed_by;                ///< the command that lists the choices of this build
  std::vector<KeyDescription> keys{};   ///< of a map, or of each map in a list

  /// The path's last part.
  std::string key() const;
};

/// Every key that `declare` declares, in its order. Defaults are the values that its pointers hold;
/// lists of maps must be empty and are empty again afterwards.
std::vector<KeyDescription> DescribeKeys(const std::function<void(Fields&)>& declare);

}  // namespace halfstep
