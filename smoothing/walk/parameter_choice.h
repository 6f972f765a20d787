#pragma once

#include <array>
#include <string_view>

#include "smoothing/walk/parameter_family.h"

namespace halfstep {

/// The numbers that limit how far methods may move each family, in the order of its row's keys.
using ParameterBounds = ByParameterFamily<std::array<double, 2>>;

/// As the rows of the families have them.
ParameterBounds DefaultBounds();

/// What a method may move besides overlaps, and how far.
struct ParameterChoice {
  // Of the families that algorithms name.
  bool heights = false;                      ///< η
  bool durations = false;                    ///< T
  bool support_points = false;               ///< where CoM and ZMP rest on one foot
  bool footsteps = false;                    ///< where feet stand, but the last of each foot
  ByParameterFamily<bool> others = {};       ///< of the other families
  ParameterBounds bounds = DefaultBounds();  ///< how far

  /// Whether methods may move the family; overlaps they always may.
  bool moves(ParameterFamily family) const;
  /// The same by the key of its flag in configs, "heights"; std::logic_error when no family has it.
  bool moves(std::string_view key) const;
  /// The flag that says so, which several families may share; null where they always may.
  bool* flag(ParameterFamily family);
  /// The number of a key such as "least_duration"; std::logic_error when no family has it.
  double& bound(std::string_view key);
  /// The same, to be read.
  double bound(std::string_view key) const;

  bool operator==(const ParameterChoice&) const = default;  ///< the same families, and as far
};

/// Every family may be moved, footsteps as well, as far as the defaults say.
ParameterChoice EveryFamily();

/// The same choice with every form and footstep as planned.
ParameterChoice WithoutForms(ParameterChoice choice);

}  // namespace halfstep
