#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/tables/csv_columns.h"
#include "experiments/tables/csv_places.h"
#include "experiments/tables/csv_reader.h"
#include "wpg/files/input_error.h"

namespace halfstep {

/// The text of a CSV file as spreadsheets write it, too: lines may end in CR LF, and a mark of
/// UTF-8 may come first; both are left out.
std::string PlainCsvText(const std::string& path);

/// A table of a walk that is being read, and the complaints about it, which are told with line and
/// column; after thirty one says that there are more.
class GivenTable {
 public:
  /// `rows` is how many the sequence asks for, one for each of `what`. Borrows `complaints`. Throws
  /// InputError for a file that cannot be read or is no CSV.
  /// `skipped`: so many rows before them are left out.
  GivenTable(const std::string& path, const CsvColumns& known, size_t rows, const std::string& what,
             Complaints* complaints, size_t skipped = 0);

  size_t num_rows() const { return fits_ ? csv_.rows.size() : 0; }  ///< 0: not as many as asked for
  std::optional<size_t> Find(const std::string& name) const;        ///< the column's index
  /// Text of a cell.
  const std::string& Cell(size_t row, size_t column) const { return csv_.rows[row][column]; }
  /// The number in a cell; none, after a complaint, when there is none.
  std::optional<double> Number(size_t row, size_t column);

  /// About a cell; `row` counts from 0, the header.
  void Complain(size_t row, size_t column, const std::string& what);
  /// About a column that is not there.
  void ComplainOfMissing(const std::string& name);

 private:
  void CheckHeader(const CsvColumns& known);

  std::string text_;
  CsvTable csv_;
  std::vector<std::vector<CsvPlace>> places_;
  Complaints* complaints_;
  bool fits_ = true;
  int num_complaints_ = 0;
};

}  // namespace halfstep
