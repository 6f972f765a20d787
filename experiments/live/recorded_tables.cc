#include "experiments/live/recorded_tables.h"

#include <cmath>

namespace halfstep {

CsvTable RecordedTables::Of(const std::string& name) const {
  const std::string path = (folder_ / (name + ".csv")).string();
  std::string text = ReadCsvText(path);
  if (is_journal_) text.resize(text.rfind('\n') + 1);
  return ParseCsv(text, path);
}

size_t IndexIn(size_t count, double value, const CsvTable& table, size_t row,
               const std::string& column) {
  if (value >= 0.0 && value < static_cast<double>(count) && value == std::floor(value)) {
    return static_cast<size_t>(value);
  }
  throw InputError({table.path + Formatted(":%zu: ", row + 2) + column + ": " +
                    Formatted("%g: there are %zu (valid: from 0, below that)", value, count)});
}

std::vector<int> Integers(const CsvTable& table, const std::string& column) {
  std::vector<int> integers;
  for (const double value : table.Numbers(column)) integers.push_back(static_cast<int>(value));
  return integers;
}

}  // namespace halfstep
