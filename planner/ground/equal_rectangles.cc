#include "planner/ground/equal_rectangles.h"

#include <algorithm>

#include "wpg/check.h"

namespace halfstep {

std::vector<CellRectangle> EqualRectangles(const std::vector<int>& values, long width, int least,
                                           size_t most) {
  HALFSTEP_CHECK(width > 0 && static_cast<long>(values.size()) % width == 0,
                 values.size() << " cells in rows of " << width);
  const long rows = static_cast<long>(values.size()) / width;
  std::vector<bool> done(values.size(), false);
  const auto at = [width](long x, long y) { return static_cast<size_t>(y * width + x); };
  const auto is_same = [&](long x, long y, int value) {
    return !done[at(x, y)] && values[at(x, y)] == value;
  };
  std::vector<CellRectangle> rectangles;
  for (long y = 0; y < rows; ++y) {
    for (long x = 0; x < width; ++x) {
      const int value = values[at(x, y)];
      if (done[at(x, y)] || value < least) continue;
      long right = x, below = y + 1;
      while (right < width && is_same(right, y, value)) ++right;
      const auto row_is_same = [&](long row) {
        for (long i = x; i < right; ++i) {
          if (!is_same(i, row, value)) return false;
        }
        return true;
      };
      while (below < rows && row_is_same(below)) ++below;
      for (long j = y; j < below; ++j) {
        for (long i = x; i < right; ++i) done[at(i, j)] = true;
      }
      rectangles.push_back({x, y, right - x, below - y, value});
      if (rectangles.size() > most) return rectangles;
    }
  }
  return rectangles;
}

}  // namespace halfstep
