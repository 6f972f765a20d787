#include "experiments/tables/given_table.h"

#include <algorithm>

#include "wpg/files/number_text.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

constexpr int kMostComplaintsAFile = 30;

}  // namespace

std::string PlainCsvText(const std::string& path) {
  std::string text = ReadCsvText(path);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  for (size_t at = 0; (at = text.find("\r\n", at)) != std::string::npos;) text.erase(at, 1);
  return text;
}

GivenTable::GivenTable(const std::string& path, const CsvColumns& known, size_t rows,
                       const std::string& what, Complaints* complaints, size_t skipped)
    : text_(PlainCsvText(path)),
      csv_(ParseCsv(text_, path)),
      places_(CsvPlaces(text_)),
      complaints_(complaints) {
  CheckHeader(known);
  const auto left_out = static_cast<std::ptrdiff_t>(std::min(skipped, csv_.rows.size()));
  csv_.rows.erase(csv_.rows.begin(), csv_.rows.begin() + left_out);
  places_.erase(places_.begin() + 1, places_.begin() + 1 + left_out);
  if (csv_.rows.size() == rows) return;
  Complain(0, 0,
           std::to_string(csv_.rows.size()) + " rows for " + std::to_string(rows) + " " + what +
               " (valid: a row for each of them)");
  fits_ = false;
}

std::optional<size_t> GivenTable::Find(const std::string& name) const {
  const auto found = std::ranges::find(csv_.header, name);
  if (found == csv_.header.end()) return std::nullopt;
  return static_cast<size_t>(found - csv_.header.begin());
}

std::optional<double> GivenTable::Number(size_t row, size_t column) {
  const NumberText number = ParseNumber(Cell(row, column));
  if (number.kind == NumberText::Kind::kNumber) return number.value;
  const bool not_finite = number.kind == NumberText::Kind::kNotFinite;
  Complain(row + 1, column,
           Quote(Cell(row, column)) + (not_finite ? " is not finite" : " is not a number") +
               " (valid: a finite decimal number)");
  return std::nullopt;
}

void GivenTable::Complain(size_t row, size_t column, const std::string& what) {
  if (++num_complaints_ > kMostComplaintsAFile + 1) return;
  const CsvPlace& place = places_[row][column];
  const bool last = num_complaints_ == kMostComplaintsAFile + 1;
  complaints_->Add(csv_.path, place.line, place.column, csv_.header[column],
                   last ? "and so on; the others are left out" : what);
}

void GivenTable::ComplainOfMissing(const std::string& name) {
  complaints_->Add(csv_.path, 1, 1, name, "no such column (valid: a table as a run writes it)");
}

void GivenTable::CheckHeader(const CsvColumns& known) {
  std::vector<std::string> names;
  std::string valid;
  for (const CsvColumn& column : known) {
    names.push_back(column.name);
    valid += (valid.empty() ? "" : ", ") + column.name;
  }
  for (size_t c = 0; c < csv_.header.size(); ++c) {
    const std::string& name = csv_.header[c];
    if (Find(name) != c) Complain(0, c, "is there twice (valid: once)");
    if (std::ranges::find(names, name) != names.end()) continue;
    Complain(0, c, "no such column (" + DidYouMean(name, names) + "valid: " + valid + ")");
  }
}

}  // namespace halfstep
