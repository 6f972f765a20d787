#pragma once

#include <string>
#include <vector>

namespace halfstep {

/// Where a cell of a CSV text begins, both from 1; columns count bytes.
struct CsvPlace {
  int line = 1, column = 1;  ///< of its first byte
};

/// The places of all cells of a text that ParseCsv() accepts: the header's row first.
std::vector<std::vector<CsvPlace>> CsvPlaces(const std::string& text);

}  // namespace halfstep
