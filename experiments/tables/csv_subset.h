#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/tables/csv_columns.h"
#include "experiments/tables/csv_reader.h"
#include "experiments/tables/csv_writer.h"

namespace halfstep {

/// The columns of a table whose names match any of `patterns` (globs), in the table's order, its
/// first column always; every `stride`-th row and the last. `columns` declares what `table` holds.
/// Throws InputError for a pattern that matches nothing, and when the declaration does not fit.
CsvFile CsvSubset(const CsvTable& table, const CsvColumns& columns,
                  const std::vector<std::string>& patterns, size_t stride);

}  // namespace halfstep
