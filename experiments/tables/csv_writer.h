#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "experiments/tables/csv_columns.h"

namespace halfstep {

/// A CSV table in memory: one header, rows of the same number of cells, each of its column's type
/// (std::logic_error otherwise), so that `pandas.read_csv(path)` gives every column its type.
/// Numbers in the shortest form that reads back to the same double, with a point or an exponent;
/// "inf", "-inf" and "nan". Texts with a comma, a quote or a line break are quoted (RFC 4180).
class CsvWriter {
 public:
  /// The header is written from the names of `columns`.
  explicit CsvWriter(CsvColumns columns);

  CsvWriter& Cell(double value);  ///< a number in its shortest exact form
  CsvWriter& Cell(long value);    ///< an integer
  CsvWriter& Cell(int value) { return Cell(static_cast<long>(value)); }  ///< an integer
  CsvWriter& Cell(bool value);                                           ///< `true` or `false`
  CsvWriter& Cell(std::string_view text);  ///< a text, quoted where it must be
  CsvWriter& Cell(const char* text) { return Cell(std::string_view(text)); }  ///< the same
  /// A number, or an empty cell.
  CsvWriter& Cell(const std::optional<double>& value) { return value ? Cell(*value) : Empty(); }
  /// Writes an empty cell, for what does not apply. In columns of numbers only: elsewhere it would
  /// change the type that pandas reads.
  CsvWriter& Empty();
  /// Ends a row. Throws std::logic_error when its number of cells is not the header's.
  void EndRow();

  const std::string& text() const { return text_; }  ///< header and rows so far
  /// Forgets them: what is written from now on goes on from there.
  void ForgetText() { text_.clear(); }
  /// The table, whole.
  CsvFile file() const { return {columns_, text_}; }

 private:
  void Begin(CsvType type);
  void Append(std::string_view text);

  CsvColumns columns_;
  size_t cells_ = 0;
  std::string text_;
};

}  // namespace halfstep
