#pragma once

#include <string>
#include <vector>

namespace halfstep {

/// A CSV text as RFC 4180 has it, read without any code of the project. Throws std::runtime_error
/// for text that is not whole: ragged rows, an open quote, no line break at the end.
class ParsedCsv {
 public:
  explicit ParsedCsv(const std::string& text);

  const std::vector<std::string>& header() const { return header_; }
  size_t size() const { return rows_.size(); }
  /// Cell of a row under a column's name.
  const std::string& Text(size_t row, const std::string& column) const;
  double Number(size_t row, const std::string& column) const;
  /// The table as text without some columns.
  std::string Without(const std::vector<std::string>& columns) const;

 private:
  void EndRow(std::vector<std::string>* row);

  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace halfstep
