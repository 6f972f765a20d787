#include "experiments/tables/csv_subset.h"

#include <fnmatch.h>

#include <charconv>

#include "experiments/tables/csv_writer.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

// Indices of the columns that are wanted.
std::vector<size_t> Wanted(const CsvColumns& columns, const std::vector<std::string>& patterns) {
  std::vector<bool> wanted(columns.size(), patterns.empty());
  wanted.front() = true;
  Complaints complaints;
  for (const std::string& pattern : patterns) {
    bool matches = false;
    for (size_t c = 0; c < columns.size(); ++c) {
      if (fnmatch(pattern.c_str(), columns[c].name.c_str(), 0) != 0) continue;
      matches = wanted[c] = true;
    }
    if (matches) continue;
    std::string valid;
    for (const CsvColumn& column : columns) valid += (valid.empty() ? "" : ", ") + column.name;
    complaints.Add("--columns", 0, 0, pattern, "no such column (valid: " + valid + ")");
  }
  complaints.ThrowIfAny();
  std::vector<size_t> indices;
  for (size_t c = 0; c < columns.size(); ++c) {
    if (wanted[c]) indices.push_back(c);
  }
  return indices;
}

// Writes a cell as a CSV has it into a column of that declaration. Throws InputError, at `place`,
// for what is no number.
void CopyCell(const std::string& cell, const CsvColumn& column, const std::string& place,
              CsvWriter* csv) {
  if (column.type == CsvType::kString) {
    csv->Cell(cell);
  } else if (cell.empty()) {
    csv->Empty();
  } else if (column.type == CsvType::kBoolean) {
    csv->Cell(cell == "true");
  } else {
    double value = 0.0;
    const char* end = cell.data() + cell.size();
    const auto read = std::from_chars(cell.data(), end, value);
    if (read.ec != std::errc() || read.ptr != end) {
      throw InputError({place + ": " + column.name + ": not a number"});
    }
    column.type == CsvType::kNumber ? csv->Cell(value) : csv->Cell(static_cast<long>(value));
  }
}

}  // namespace

CsvFile CsvSubset(const CsvTable& table, const CsvColumns& columns,
                  const std::vector<std::string>& patterns, size_t stride) {
  for (size_t c = 0; c < columns.size(); ++c) {
    if (table.header.size() == columns.size() && table.header[c] == columns[c].name) continue;
    throw InputError({table.path + ":1: its columns are not those of this robot's trajectory"});
  }
  const std::vector<size_t> wanted = Wanted(columns, patterns);
  CsvColumns kept;
  for (const size_t c : wanted) kept.push_back(columns[c]);
  CsvWriter csv(kept);
  for (size_t row = 0; row < table.rows.size(); ++row) {
    if (row % stride != 0 && row + 1 != table.rows.size()) continue;
    const std::string place = table.path + ":" + std::to_string(row + 2);
    for (const size_t c : wanted) CopyCell(table.rows[row][c], columns[c], place, &csv);
    csv.EndRow();
  }
  return csv.file();
}

}  // namespace halfstep
