#pragma once

#include <optional>
#include <string>
#include <vector>

namespace halfstep {

/// A CSV file in memory, as CsvWriter writes it.
struct CsvTable {
  std::string path;                            ///< as it was opened, for complaints
  std::vector<std::string> header;             ///< the columns' names
  std::vector<std::vector<std::string>> rows;  ///< texts, one for each column

  /// Whether there is such a column.
  bool Has(const std::string& column) const;
  /// A column of numbers. Throws InputError, with the line, for what is not a number, and when
  /// there is no such column.
  std::vector<double> Numbers(const std::string& column) const;
  /// The same, with none for each empty cell.
  std::vector<std::optional<double>> NumbersOrEmpty(const std::string& column) const;
  /// A column as text. Throws InputError when there is no such column.
  std::vector<std::string> Texts(const std::string& column) const;

 private:
  size_t Index(const std::string& column) const;
  double Number(size_t row, size_t column) const;
};

/// Throws InputError as path:line: when a row has not as many cells as the header, when a quote is
/// left open, or when the file cannot be read or exceeds 1 GiB.
CsvTable ReadCsv(const std::string& path);
/// The text of the file, not parsed.
std::string ReadCsvText(const std::string& path);
/// The same for a text; `path` stands for it in complaints.
CsvTable ParseCsv(const std::string& text, const std::string& path);

}  // namespace halfstep
