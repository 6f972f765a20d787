#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/tables/csv_reader.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep {

/// The tables of an episode's folder, or of its journal, as they are read.
class RecordedTables {
 public:
  /// Of a journal, a line that was cut is left out.
  RecordedTables(std::filesystem::path folder, bool is_journal)
      : folder_(std::move(folder)), is_journal_(is_journal) {}

  const std::filesystem::path& folder() const { return folder_; }  ///< where they are
  /// "worlds": that of worlds.csv, by columns. Throws InputError.
  CsvTable Of(const std::string& name) const;

 private:
  std::filesystem::path folder_;
  bool is_journal_;
};

/// The entry of `all` whose name stands in a cell. Throws InputError where there is none.
template <typename Enum, size_t n>
Enum Named(const std::array<Enum, n>& all, const std::string& name, const CsvTable& table,
           size_t row) {
  std::string valid;
  for (const Enum one : all) {
    if (Name(one) == name) return one;
    valid += (valid.empty() ? "" : ", ") + std::string(Name(one));
  }
  throw InputError(
      {table.path + Formatted(":%zu: ", row + 2) + Quote(name) + " (valid: " + valid + ")"});
}

/// An index into a list that has `count` entries. Throws InputError for what is none.
size_t IndexIn(size_t count, double value, const CsvTable& table, size_t row,
               const std::string& column);

/// The whole numbers of a column.
std::vector<int> Integers(const CsvTable& table, const std::string& column);

}  // namespace halfstep
