#pragma once

#include <string>

#include "experiments/tables/csv_columns.h"

namespace halfstep {

/// The columns of a table as the arrays of a NumPy archive: an uncompressed zip file with a member
/// COLUMN.npy for each (format 1.0): numbers as float64, bit-equal to the CSV's, integers as int64,
/// truth values as bool, texts as unicode of the longest's length. Empty cells of numbers are nan.
/// `path` stands for the table in complaints. The bytes depend on the table only. Throws InputError
/// for cells that are not of their column's type and for archives of 4 GiB or more.
/// Source: [NumpyFormat], [Zip].
std::string NpzFile(const CsvFile& table, const std::string& path);

}  // namespace halfstep
