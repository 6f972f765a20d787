#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "smoothing/margins/margin.h"

namespace halfstep {

/// What the values of a family need, from little work to much. Families that need little are asked
/// first, so that most violations are found with little work.
enum class MarginCost : int {
  kWalk,         ///< the superposed quantities
  kPosture,      ///< joint angles
  kJointSpeeds,  ///< joint speeds, poses of links
  kObstacles,    ///< distances of bodies to obstacles
  kPairs,        ///< distances of bodies to each other
};

/// What a family is called and how it is used. Each class of a family has one as `kTraits`.
struct FamilyTraits {
  MarginFamily family;       ///< of which this is told
  std::string_view name;     ///< in YAML, CSV and certificates
  std::string_view unit;     ///< "m", "rad" …; "1" for a pure number
  std::string_view key;      ///< under `smoothing.margins`: the name and, by its unit, an ending
  std::string_view meaning;  ///< of the key
  std::string_view remedy;   ///< what may help a planned motion that misses the demand
  double scale;              ///< what counts as a clear change of the margin [its unit]
  double demanded;           ///< by default [its unit]
  bool raised;      ///< whether the program `safest` raises it, not only keeps what is demanded
  MarginCost cost;  ///< what an evaluation needs
  /// The family whose row of the program it shares, mostly itself; none when no parameter moves the
  /// margin, so that it has no row.
  std::optional<MarginFamily> row;
  bool may_be_none = false;  ///< whether it can be left out: then nothing is demanded of it
  double most = 0.5;         ///< that may be demanded [its unit]
  /// Whether only some robots have it (MarginStatements::present): then a config that is written
  /// back has its key only where something else than `demanded` is demanded.
  bool for_some_robots = false;
};

/// The traits of a family.
const FamilyTraits& Traits(MarginFamily family);

/// All families, those that need little work first.
std::span<const MarginFamily> FamiliesByCost();

}  // namespace halfstep
