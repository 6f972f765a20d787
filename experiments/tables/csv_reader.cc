#include "experiments/tables/csv_reader.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "wpg/files/input_error.h"
#include "wpg/files/regular_file.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

constexpr std::uint64_t kMostBytes = 1 << 30;

[[noreturn]] void Refuse(const std::string& path, size_t line, const std::string& what) {
  throw InputError({path + ":" + std::to_string(line) + ": " + what});
}

// Splits a text that comes in parts into rows.
class CsvParser {
 public:
  CsvParser(const std::string& path, CsvRowLook look) : path_(path), look_(std::move(look)) {}

  // Whether more is wanted.
  bool Add(std::string_view part) {
    for (const char c : part) {
      if (std::exchange(returned_, false) && c != '\n') row_.back() += '\r';
      if (state_ == State::kQuoted) {
        if (c == '"') {
          state_ = State::kAfterQuote;
        } else {
          row_.back() += c;
        }
      } else if (state_ == State::kAfterQuote && c == '"') {  // a doubled one
        row_.back() += c;
        state_ = State::kQuoted;
      } else if (c == '"' && row_.back().empty() && state_ == State::kPlain) {
        state_ = State::kQuoted;
      } else {
        state_ = State::kPlain;
        if (c == ',') {
          row_.emplace_back();
        } else if (c == '\r') {
          returned_ = true;
        } else if (c != '\n') {
          row_.back() += c;
          // Spreadsheets write a byte order mark before the first line.
          if (line_ == 1 && row_.size() == 1 && row_.back() == "\xEF\xBB\xBF") row_.back().clear();
        } else if (!EndRow()) {
          return false;
        }
      }
    }
    return true;
  }
  void Finish() const {
    if (state_ == State::kQuoted || returned_ || row_.size() > 1 || !row_.back().empty()) {
      Refuse(path_, line_, "the last line is cut (valid: it ends with a line break)");
    }
    if (header_.empty()) Refuse(path_, 1, "no header");
  }
  const std::vector<std::string>& header() const { return header_; }

 private:
  enum class State { kPlain, kQuoted, kAfterQuote };

  bool EndRow() {
    bool more = true;
    if (header_.empty()) {
      header_ = row_;
    } else if (row_.size() != header_.size()) {
      Refuse(
          path_, line_,
          std::to_string(row_.size()) + " cells, the header has " + std::to_string(header_.size()));
    } else {
      more = look_(header_, row_);
    }
    row_.assign(1, "");
    ++line_;
    return more;
  }

  const std::string& path_;
  const CsvRowLook look_;
  State state_ = State::kPlain;
  bool returned_ = false;  // the character before was '\r' outside quotes: lines end so on Windows
  std::vector<std::string> header_, row_ = {""};
  size_t line_ = 1;
};

}  // namespace

CsvTable ReadCsv(const std::string& path) { return ParseCsv(ReadCsvText(path), path); }

std::string ReadCsvText(const std::string& path) { return ReadRegularFile(path, kMostBytes); }

CsvTable ParseCsv(const std::string& text, const std::string& path) {
  CsvTable table{path, {}, {}};
  CsvParser parser(path, [&](const std::vector<std::string>&, const std::vector<std::string>& row) {
    table.rows.push_back(row);
    return true;
  });
  parser.Add(text);
  parser.Finish();
  table.header = parser.header();
  return table;
}

void EachCsvRow(const std::string& path, const CsvRowLook& look) {
  CsvParser parser(path, look);
  bool all = true;
  ReadRegularFileParts(path, [&](std::string_view part) { return all = parser.Add(part); });
  if (all) parser.Finish();
}

bool CsvTable::Has(const std::string& column) const {
  return std::ranges::find(header, column) != header.end();
}

size_t CsvTable::Index(const std::string& column) const {
  const auto found = std::find(header.begin(), header.end(), column);
  if (found == header.end()) Refuse(path, 1, "no column '" + column + "'");
  return static_cast<size_t>(found - header.begin());
}

double CsvTable::Number(size_t row, size_t column) const {
  const std::string& cell = rows[row][column];
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) {
    Refuse(path, row + 2, header[column] + ": not a number: " + Quote(cell));
  }
  return value;
}

std::vector<double> CsvTable::Numbers(const std::string& column) const {
  const size_t index = Index(column);
  std::vector<double> numbers;
  for (size_t i = 0; i < rows.size(); ++i) numbers.push_back(Number(i, index));
  return numbers;
}

std::vector<std::optional<double>> CsvTable::NumbersOrEmpty(const std::string& column) const {
  const size_t index = Index(column);
  std::vector<std::optional<double>> numbers;
  for (size_t i = 0; i < rows.size(); ++i) {
    numbers.push_back(rows[i][index].empty() ? std::nullopt : std::optional(Number(i, index)));
  }
  return numbers;
}

std::vector<std::string> CsvTable::Texts(const std::string& column) const {
  const size_t index = Index(column);
  std::vector<std::string> texts;
  for (const std::vector<std::string>& row : rows) texts.push_back(row[index]);
  return texts;
}

}  // namespace halfstep
