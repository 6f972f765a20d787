#pragma once

#include <memory>
#include <type_traits>

#include "smoothing/margins/margin_statements.h"

namespace halfstep {

/// What the house needs of a family's class, which stands in NAME_margin.cc and is known to no
/// other file.
struct FamilyClass {
  const FamilyTraits& traits;  ///< of the class
  /// Its statements about a robot in a scene; `place` is borrowed.
  std::unique_ptr<const MarginStatements> (*make)(const MarginPlace& place);
};

/// That of a class with `kTraits` and a constructor that takes a MarginPlace.
template <typename Family>
inline constexpr FamilyClass kClassOf = [] {
  static_assert(IsComplete(Family::kTraits), "kTraits leaves out what a family has to say");
  return FamilyClass{Family::kTraits, [](const MarginPlace& place) {
                       return std::unique_ptr<const MarginStatements>(new Family(place));
                     }};
}();

/// Names a family as a type. For each family, its file defines
///
///     const FamilyClass& ClassOf(FamilyTag<MarginFamily::kName>);
///
/// A family without this does not link, and one without a bound or with incomplete traits does not
/// compile; there is no list in which it could stand in another place.
template <MarginFamily kFamily>
using FamilyTag = std::integral_constant<MarginFamily, kFamily>;
/// The tag of a class.
template <typename Family>
using TagOf = FamilyTag<Family::kTraits.family>;

/// The class of a family.
const FamilyClass& ClassOf(MarginFamily family);

}  // namespace halfstep
