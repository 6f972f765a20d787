#include "experiments/csv_reader.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>

#include "wpg/input/input_error.h"

namespace halfstep {
namespace {

[[noreturn]] void Refuse(const std::string& path, size_t line, const std::string& what) {
  throw InputError({path + ":" + std::to_string(line) + ": " + what});
}

}  // namespace

CsvTable ReadCsv(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError({path + ": cannot be read"});
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  CsvTable table{path, {}, {}};
  std::vector<std::string> row(1);
  bool quoted = false;
  size_t line = 1;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
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
  if (quoted || row.size() > 1 || !row.back().empty()) Refuse(path, line, "the last line is cut");
  if (table.header.empty()) Refuse(path, 1, "no header");
  return table;
}

std::vector<double> CsvTable::Numbers(const std::string& column) const {
  const auto found = std::find(header.begin(), header.end(), column);
  if (found == header.end()) Refuse(path, 1, "no column '" + column + "'");
  const size_t index = static_cast<size_t>(found - header.begin());
  std::vector<double> numbers;
  for (size_t i = 0; i < rows.size(); ++i) {
    const std::string& cell = rows[i][index];
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size()) {
      Refuse(path, i + 2, column + ": not a number: '" + cell + "'");
    }
    numbers.push_back(value);
  }
  return numbers;
}

}  // namespace halfstep
