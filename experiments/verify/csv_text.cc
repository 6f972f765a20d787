#include "experiments/verify/csv_text.h"

#include <charconv>
#include <string_view>

#include "experiments/verify/findings.h"
#include "wpg/files/input_error.h"
#include "wpg/files/regular_file.h"
#include "wpg/files/text.h"

namespace halfstep::verify {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;
constexpr size_t kPart = 4096;  // rows that InParts() holds

// Cells of a line; false: a quote out of place.
bool Split(std::string_view line, std::vector<std::string>* cells) {
  cells->assign(1, "");
  bool quoted = false, closed = false;
  for (size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted) {
      if (c != '"') {
        cells->back() += c;
      } else if (i + 1 < line.size() && line[i + 1] == '"') {
        cells->back() += line[++i];
      } else {
        quoted = false;
        closed = true;
      }
    } else if (c == ',') {
      cells->emplace_back();
      closed = false;
    } else if (c == '"' && cells->back().empty() && !closed) {
      quoted = true;
    } else if (c == '"' || closed) {
      return false;
    } else {
      cells->back() += c;
    }
  }
  return !quoted;
}

}  // namespace

std::string ReadBytes(const std::string& path) { return ReadRegularFile(path, kMostBytes); }

CsvText::CsvText(std::string path, const std::string& text, const std::vector<std::string>& header)
    : path_(std::move(path)), header_(header) {
  Parse(text, {});
}

void CsvText::InParts(std::string path, const std::string& text,
                      const std::vector<std::string>& header,
                      const std::function<void(const CsvText&)>& read) {
  CsvText csv;
  csv.path_ = std::move(path);
  csv.header_ = header;
  csv.Parse(text, read);
  if (csv.size() > 0) read(csv);
}

void CsvText::Parse(std::string_view text, const std::function<void(const CsvText&)>& read) {
  std::string_view rest = text;
  std::vector<std::string> cells;
  for (long line = 1; !rest.empty(); ++line) {
    const auto fail = [&](const std::string& what) {
      throw InputError({path_ + ":" + std::to_string(line) + ": " + what});
    };
    const size_t end = rest.find('\n');
    if (end == std::string_view::npos) fail("the last line has no end: the file is cut off");
    if (!Split(rest.substr(0, end), &cells)) fail("a quote is open or out of place");
    rest.remove_prefix(end + 1);
    if (line > 1) {
      if (cells.size() != header_.size()) {
        fail(Formatted("%zu cells (valid: %zu)", cells.size(), header_.size()));
      }
      if (read && rows_.size() == kPart) {
        read(*this);
        before_ += rows_.size();
        rows_.clear();
      }
      rows_.push_back(cells);
      continue;
    }
    for (size_t i = 0; i < std::max(cells.size(), header_.size()); ++i) {
      const std::string found = i < cells.size() ? Quote(cells[i]) : "nothing";
      const std::string wanted = i < header_.size() ? header_[i] : "no further column";
      if (i >= cells.size() || i >= header_.size() || cells[i] != header_[i]) {
        fail(Formatted("column %zu is %s (valid: %s)", i + 1, found.c_str(), wanted.c_str()));
      }
    }
  }
  if (text.empty()) throw InputError({path_ + ":1: the file is empty"});
}

void CsvText::Refuse(size_t row, size_t column, const std::string& what) const {
  throw InputError({path_ + ":" + std::to_string(before_ + row + 2) + ": " + header_[column] +
                    ": " + Quote(rows_[row][column]) + " " + what});
}

double CsvText::Number(size_t row, size_t column) const {
  const std::string& text = rows_[row][column];
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) Refuse(row, column, "is not a number");
  return value;
}

int CsvText::Whole(size_t row, size_t column, int least) const {
  const std::string& text = rows_[row][column];
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || value < least || value > 1000000000) {
    Refuse(row, column, "is not a whole number from " + std::to_string(least) + " on");
  }
  return value;
}

const std::string& CsvText::Word(size_t row, size_t column,
                                 const std::vector<std::string>& words) const {
  std::string valid;
  for (const std::string& word : words) {
    if (Cell(row, column) == word) return Cell(row, column);
    valid += (valid.empty() ? "" : ", ") + word;
  }
  Refuse(row, column, "is not valid (valid: " + valid + ")");
}

void CsvText::CheckFirst(size_t row, int number) const {
  if (Number(row, 0) != number) Refuse(row, 0, "is not " + std::to_string(number));
}

}  // namespace halfstep::verify
