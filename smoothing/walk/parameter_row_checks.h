#pragma once

#include <algorithm>
#include <span>

#include "smoothing/walk/parameter_ranges.h"

namespace halfstep {

/// Whether each family has its row, in the order of ParameterFamily.
constexpr bool AreInOrder(std::span<const ParameterFamilyTraits> rows) {
  for (size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].family != static_cast<ParameterFamily>(i)) return false;
  }
  return rows.size() == kNumParameterFamilies;
}

/// Whether a row tells the number of a half-step that it is where its part has one, and nowhere
/// else.
constexpr bool TellsItsNumber(const ParameterFamilyTraits& row) {
  const bool number = row.number != nullptr, shape = row.shape != nullptr;
  const bool move = row.move != nullptr;
  if (row.factor && row.part != ParameterPart::kState) return false;
  switch (row.part) {
    case ParameterPart::kBegin:
      return !number && !shape && !move;
    case ParameterPart::kDuration:
      return number && !shape && !move;
    case ParameterPart::kState:
      return number != shape && !move;
    case ParameterPart::kProfile:
      return !number && shape && !move;
    case ParameterPart::kFootstep:
      return !number && !shape && move;
  }
  return false;
}

/// Whether rows leave out nothing of what they have to say.
constexpr bool AreComplete(std::span<const ParameterFamilyTraits> rows) {
  return std::ranges::all_of(rows, [](const ParameterFamilyTraits& row) {
    return !row.name.empty() && !row.column.empty() && !row.meaning.empty() &&
           row.least < row.most && row.range_of != nullptr && TellsItsNumber(row) &&
           (row.of == ParameterOf::kJunction) == (row.part == ParameterPart::kBegin) &&
           (row.of_form || row.values != nullptr) &&
           (row.always || row.range_of == ranges::Anywhere || row.bounds().size() > 0) &&
           (row.always || !row.key.empty() || row.chosen != nullptr) &&
           (row.always || row.key.empty() || !row.key_meaning.empty());
  });
}

/// Whether no other row has the same name, column, key, place of values or of the flag.
constexpr bool IsOneOfAKind(const ParameterFamilyTraits& row,
                            std::span<const ParameterFamilyTraits> rows) {
  return std::ranges::all_of(rows, [&row](const ParameterFamilyTraits& other) {
    if (other.family == row.family) return true;
    const bool same_flag = row.chosen != nullptr && other.chosen == row.chosen;
    const bool in_one_table =
        (other.of == ParameterOf::kJunction) == (row.of == ParameterOf::kJunction);
    return other.name != row.name && other.column != row.column &&
           (other.rank != row.rank || !in_one_table) && (row.key.empty() || other.key != row.key) &&
           (row.values == nullptr || other.values != row.values) &&
           (!same_flag || row.key.empty() || other.key.empty());
  });
}

/// Whether all rows are of a kind of their own.
constexpr bool AllDiffer(std::span<const ParameterFamilyTraits> rows) {
  return std::ranges::all_of(
      rows, [rows](const ParameterFamilyTraits& row) { return IsOneOfAKind(row, rows); });
}

}  // namespace halfstep
