#include "experiments/tables/csv_places.h"

namespace halfstep {

std::vector<std::vector<CsvPlace>> CsvPlaces(const std::string& text) {
  std::vector<std::vector<CsvPlace>> rows;
  CsvPlace here;
  size_t i = 0;
  const auto step = [&] {
    here = text[i] == '\n' ? CsvPlace{here.line + 1, 1} : CsvPlace{here.line, here.column + 1};
    ++i;
  };
  while (i < text.size()) {
    std::vector<CsvPlace>& row = rows.emplace_back(1, here);
    bool quoted = false, empty = true, ended = false;
    while (i < text.size() && !ended) {
      const char c = text[i];
      const bool doubled = quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"';
      if (doubled) step();
      step();
      if (c == '"' && !doubled && (quoted || empty)) {
        quoted = !quoted;
      } else if (c == ',' && !quoted) {
        row.push_back(here);
        empty = true;
      } else {
        ended = c == '\n' && !quoted;
        empty = false;
      }
    }
    if (!ended) rows.pop_back();  // no row, but an empty cell after the last line
  }
  return rows;
}

}  // namespace halfstep
