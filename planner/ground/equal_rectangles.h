#pragma once

#include <cstddef>
#include <vector>

namespace halfstep {

/// Cells of a grid with one value: columns x … x + width − 1 of rows y … y + height − 1.
struct CellRectangle {
  long x = 0, y = 0;           ///< of its first cell
  long width = 0, height = 0;  ///< in cells
  int value = 0;               ///< of all its cells
};

/// Divides the cells of a grid, `width` a row, into rectangles of one value each: from the first
/// cell that is left, as wide as it goes, then as high. Cells below `least` are left out. Ends
/// after `most` + 1 rectangles. Precondition: `values` are whole rows (std::logic_error).
std::vector<CellRectangle> EqualRectangles(const std::vector<int>& values, long width, int least,
                                           size_t most);

}  // namespace halfstep
