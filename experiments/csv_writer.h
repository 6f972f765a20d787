#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace halfstep {

/// A CSV table in memory: one header, rows of the same number of cells. Numbers in the shortest
/// form that reads back to the same double; "inf", "-inf" and "nan" as pandas reads them. Texts
/// with a comma, a quote or a line break are quoted (RFC 4180).
class CsvWriter {
 public:
  explicit CsvWriter(const std::vector<std::string>& header);

  CsvWriter& Cell(double value);
  CsvWriter& Cell(long value);
  CsvWriter& Cell(int value) { return Cell(static_cast<long>(value)); }
  CsvWriter& Cell(bool value) { return Cell(std::string_view(value ? "true" : "false")); }
  CsvWriter& Cell(std::string_view text);
  CsvWriter& Cell(const char* text) { return Cell(std::string_view(text)); }
  CsvWriter& Empty() { return Cell(std::string_view()); }
  /// Ends a row. Throws std::logic_error when its number of cells is not the header's.
  void EndRow();

  const std::string& text() const { return text_; }

 private:
  void Separate();

  size_t columns_;
  size_t cells_ = 0;
  std::string text_;
};

}  // namespace halfstep
