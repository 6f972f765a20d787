#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "smoothing/margins/margin.h"

namespace halfstep {

/// How much work the values of a family are. Cheap families are asked first, so that what is
/// violated is mostly found with little work.
enum class MarginCost : int {
  kWalk,         ///< the superposed quantities
  kPosture,      ///< joint angles
  kJointSpeeds,  ///< joint speeds, poses of links
  kObstacles,    ///< distances of bodies to obstacles
  kPairs,        ///< distances of bodies to each other
};

/// What a family is called and how it is used. Each class of a family has one as `kTraits`.
struct FamilyTraits {
  MarginFamily family;
  std::string_view name;     ///< in YAML, CSV and certificates
  std::string_view unit;     ///< "m", "rad" …
  std::string_view key;      ///< under `smoothing.margins`
  std::string_view meaning;  ///< of the key
  double scale;              ///< what counts as a clear change of the margin [its unit]
  double demanded;           ///< by default [its unit]
  bool raised;               ///< whether `safest` raises it; else it is kept at what is demanded
  MarginCost cost;
  /// Family whose row of the program it shares, mostly its own; none: it has no row, for no
  /// parameter moves it.
  std::optional<MarginFamily> row;
};

const FamilyTraits& Traits(MarginFamily family);

/// All families, those with little work first.
const std::array<MarginFamily, kNumMarginFamilies>& FamiliesByCost();

}  // namespace halfstep
