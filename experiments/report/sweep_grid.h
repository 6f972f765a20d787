#pragma once

#include <string>
#include <vector>

#include "experiments/tables/csv_reader.h"

namespace halfstep {

/// Keys of a sweep that advance together, or one that varies by itself.
struct SweptKeys {
  std::vector<std::string> keys;                 ///< dotted
  std::vector<std::vector<std::string>> values;  ///< of each of their values, a text a key
  std::vector<int> at;                           ///< of each case: index into `values`
};

/// The cases of a sweep's runs.csv in their order, and what tells them apart.
struct SweepGrid {
  std::vector<std::string> ids;     ///< of the cases
  std::vector<size_t> case_of_row;  ///< index into `ids`
  std::vector<SweptKeys> axes;      ///< those with two values or more
  /// Keys with the same value in every case, and that value.
  std::vector<std::pair<std::string, std::string>> constants;
};

/// Throws InputError when a key has no column.
SweepGrid GridOf(const CsvTable& runs, const std::vector<std::string>& keys);

/// Every n-th value of an axis.
struct Thinning {
  std::vector<int> stride;   ///< of each axis, 1: all values
  std::vector<size_t> kept;  ///< cases of which all values are kept, rising
};

/// Doubles the stride of the axis with the most values until at most `most` cases are kept.
Thinning ThinnedTo(const SweepGrid& grid, size_t most);

}  // namespace halfstep
