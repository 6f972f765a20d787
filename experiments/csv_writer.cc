#include "experiments/csv_writer.h"

#include <array>
#include <charconv>
#include <cmath>

#include "wpg/check.h"

namespace halfstep {

CsvWriter::CsvWriter(const std::vector<std::string>& header) : columns_(header.size()) {
  for (const std::string& name : header) Cell(std::string_view(name));
  EndRow();
}

void CsvWriter::Separate() {
  if (cells_++ > 0) text_ += ',';
}

CsvWriter& CsvWriter::Cell(double value) {
  Separate();
  if (std::isfinite(value)) {
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    text_.append(digits.data(), end);
  } else {
    text_ += std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  }
  return *this;
}

CsvWriter& CsvWriter::Cell(long value) {
  Separate();
  text_ += std::to_string(value);
  return *this;
}

CsvWriter& CsvWriter::Cell(std::string_view text) {
  Separate();
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    text_ += text;
    return *this;
  }
  text_ += '"';
  for (char c : text) {
    if (c == '"') text_ += '"';
    text_ += c;
  }
  text_ += '"';
  return *this;
}

void CsvWriter::EndRow() {
  HALFSTEP_CHECK(cells_ == columns_, cells_ << " cells in a row of " << columns_);
  text_ += '\n';
  cells_ = 0;
}

}  // namespace halfstep
