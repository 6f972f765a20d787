#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "smoothing/walk/parameter_families.h"

/// Ranges of what methods choose from (ParameterFamilyTraits::range_of): least and most, by a row,
/// the numbers of its keys and the planned value, which is in all of them.
namespace halfstep::ranges {

using Row = ParameterFamilyTraits;        ///< whose range it is
using Bounds = std::array<double, 2>;     ///< the numbers of its keys
using Range = std::pair<double, double>;  ///< least and most

/// From the planned value on.
inline Range UpFromPlanned(const Row&, const Bounds&, double planned) {
  return {planned, std::numeric_limits<double>::infinity()};
}
/// From the first bound.
inline Range UpToPlanned(const Row&, const Bounds& bounds, double planned) {
  return {bounds[0], planned};
}
/// The bounds times the planned value.
inline Range OfPlanned(const Row&, const Bounds& bounds, double planned) {
  return {bounds[0] * planned, bounds[1] * planned};
}
/// The bounds.
inline Range Between(const Row&, const Bounds& bounds, double planned) {
  return {std::min(bounds[0], planned), std::max(bounds[1], planned)};
}
/// From the first bound to the most that makes sense.
inline Range UpToMost(const Row& row, const Bounds& bounds, double planned) {
  return {std::min(bounds[0], planned), row.most};
}
/// The first bound to either side of the planned value, as far as it makes sense.
inline Range AboutPlanned(const Row& row, const Bounds& bounds, double planned) {
  return {std::max(row.least, planned - bounds[0]), std::min(row.most, planned + bounds[0])};
}
/// All that makes sense.
inline Range Anywhere(const Row& row, const Bounds&, double) { return {row.least, row.most}; }
/// The first bound to either side of 0.
inline Range AboutZero(const Row&, const Bounds& bounds, double) { return {-bounds[0], bounds[0]}; }

}  // namespace halfstep::ranges
