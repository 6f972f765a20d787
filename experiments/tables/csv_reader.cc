#include "experiments/tables/csv_reader.h"

#include <algorithm>
#include <charconv>

#include "wpg/files/input_error.h"
#include "wpg/files/regular_file.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

constexpr std::uint64_t kMostBytes = 1 << 30;

[[noreturn]] void Refuse(const std::string& path, size_t line, const std::string& what) {
  throw InputError({path + ":" + std::to_string(line) + ": " + what});
}

}  // namespace

CsvTable ReadCsv(const std::string& path) { return ParseCsv(ReadCsvText(path), path); }

std::string ReadCsvText(const std::string& path) { return ReadRegularFile(path, kMostBytes); }

CsvTable ParseCsv(const std::string& text, const std::string& path) {
  CsvTable table{path, {}, {}};
  std::vector<std::string> row(1);
  bool quoted = false;
  size_t line = 1;
  // Spreadsheets write a byte order mark before the first line.
  for (size_t i = text.starts_with("\xEF\xBB\xBF") ? 3 : 0; i < text.size(); ++i) {
    const char c = text[i];
    if (!quoted && text.compare(i, 2, "\r\n") == 0) continue;  // lines end so on Windows
    if (quoted) {
      const bool doubled = c == '"' && i + 1 < text.size() && text[i + 1] == '"';
      if (doubled) ++i;
      if (c == '"' && !doubled) {
        quoted = false;
      } else {
        row.back() += c;
      }
    } else if (c == '"' && row.back().empty()) {
      quoted = true;
    } else if (c == ',') {
      row.emplace_back();
    } else if (c == '\n') {
      if (table.header.empty()) {
        table.header = row;
      } else if (row.size() != table.header.size()) {
        Refuse(path, line,
               std::to_string(row.size()) + " cells, the header has " +
                   std::to_string(table.header.size()));
      } else {
        table.rows.push_back(row);
      }
      row.assign(1, "");
      ++line;
    } else {
      row.back() += c;
    }
  }
  if (quoted || row.size() > 1 || !row.back().empty()) {
    Refuse(path, line, "the last line is cut (valid: it ends with a line break)");
  }
  if (table.header.empty()) Refuse(path, 1, "no header");
  return table;
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
