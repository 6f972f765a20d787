#include "experiments/tables/csv_writer.h"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "wpg/check.h"

namespace halfstep {

CsvWriter::CsvWriter(CsvColumns columns) : columns_(std::move(columns)) {
  for (const CsvColumn& column : columns_) {
    if (&column != &columns_.front()) text_ += ',';
    Append(column.name);
  }
  text_ += '\n';
}

void CsvWriter::Begin(CsvType type) {
  HALFSTEP_CHECK(cells_ < columns_.size(), "more cells in a row than " << columns_.size());
  HALFSTEP_CHECK(columns_[cells_].type == type,
                 columns_[cells_].name << ": a cell of another type");
  if (cells_++ > 0) text_ += ',';
}

CsvWriter& CsvWriter::Cell(double value) {
  Begin(CsvType::kNumber);
  if (std::isfinite(value)) {
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    const std::string_view number(digits.data(), static_cast<size_t>(end - digits.data()));
    text_ += number;
    if (number.find_first_of(".e") == std::string_view::npos) text_ += ".0";
  } else {
    text_ += std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  }
  return *this;
}

CsvWriter& CsvWriter::Cell(long value) {
  Begin(CsvType::kInteger);
  text_ += std::to_string(value);
  return *this;
}

CsvWriter& CsvWriter::Cell(bool value) {
  Begin(CsvType::kBoolean);
  text_ += value ? "true" : "false";
  return *this;
}

CsvWriter& CsvWriter::Cell(std::string_view text) {
  Begin(CsvType::kString);
  HALFSTEP_CHECK(!text.empty(), columns_[cells_ - 1].name << ": an empty text");
  Append(text);
  return *this;
}

CsvWriter& CsvWriter::Empty() {
  Begin(CsvType::kNumber);
  return *this;
}

void CsvWriter::Append(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    text_ += text;
    return;
  }
  text_ += '"';
  for (char c : text) {
    if (c == '"') text_ += '"';
    text_ += c;
  }
  text_ += '"';
}

void CsvWriter::EndRow() {
  HALFSTEP_CHECK(cells_ == columns_.size(), cells_ << " cells in a row of " << columns_.size());
  text_ += '\n';
  cells_ = 0;
}

}  // namespace halfstep
