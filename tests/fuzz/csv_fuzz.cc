// A CSV table, by both readers: what the checker's strict one accepts, the other reads the same.
// Every cell has a place.

#include "experiments/tables/csv_places.h"
#include "experiments/tables/csv_reader.h"
#include "experiments/verify/csv_text.h"
#include "tests/fuzz/fuzz.h"

using namespace halfstep;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text = fuzz::Text(data, size), path = "fuzz.csv";
  CsvTable table;
  if (!fuzz::Reads(path, [&] { table = ParseCsv(text, path); })) return 0;
  const auto places = CsvPlaces(text);
  fuzz::Require(places.size() == table.rows.size() + 1, "places of other rows", text);
  for (const auto& row : places) {
    fuzz::Require(row.size() == table.header.size(), "places of other cells", text);
  }
  for (const std::string& column : table.header) {
    fuzz::Require(table.Texts(column).size() == table.rows.size(), "a column is too short");
    fuzz::Reads(path, [&] { (void)table.NumbersOrEmpty(column); });
  }
  fuzz::Reads(path, [&] {
    const verify::CsvText strict(path, text, table.header);
    fuzz::Require(strict.size() == table.rows.size(), "the readers see other rows", text);
    for (size_t row = 0; row < strict.size(); ++row) {
      for (size_t column = 0; column < table.header.size(); ++column) {
        fuzz::Require(strict.Cell(row, column) == table.rows[row][column],
                      "the readers see other cells", text);
        fuzz::Reads(path, [&] { (void)strict.Number(row, column); });
        fuzz::Reads(path, [&] { (void)strict.Positive(row, column); });
      }
    }
  });
  return 0;
}
