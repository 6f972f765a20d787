#include "planner/ground/heightmap.h"

#include <algorithm>
#include <map>

#include "planner/ground/equal_rectangles.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

constexpr double kLeastMapArea = 0.01;        // of a level [m²]: no sole stands on less
constexpr size_t kMostMapLevels = 200;        // a map with more is no level ground
constexpr size_t kMostPrisms = 20'000;        // of a map
constexpr double kGreyRounding = 1.0 + 1e-9;  // of the tolerance in grey values

// What a grey value becomes: the highest of its level's band, and whether that is a level.
struct Band {
  int top = 0;
  bool bears = false;
};

// The band of each value that is there, from `lowest` on. Empty: too many levels.
std::map<int, Band> BandsOf(const std::map<int, long>& counts, int lowest, int width,
                            double least_cells) {
  std::map<int, long> left(counts.lower_bound(lowest), counts.end());
  std::map<int, Band> bands;
  for (size_t levels = 0;; ++levels) {
    // The band that begins at a value that is there, by two ends that only go up.
    long most = 0;
    auto first = left.end(), last = left.end();
    auto end = left.begin();
    long sum = 0;
    for (auto begin = left.begin(); begin != left.end(); ++begin) {
      while (end != left.end() && end->first - begin->first <= width) {
        sum += end->second;
        ++end;
      }
      if (sum > most) {
        most = sum;
        first = begin;
        last = end;
      }
      sum -= begin->second;
    }
    if (most == 0 || static_cast<double>(most) < least_cells) break;
    if (levels == kMostMapLevels) return {};
    const int top = std::prev(last)->first;
    for (auto value = first; value != last; ++value) bands[value->first] = {top, true};
    left.erase(first, last);
  }
  for (const auto& [value, count] : left) bands[value] = {value, false};
  return bands;
}

}  // namespace

HeightmapSurfaces SurfacesOf(const std::string& name, const GreyImage& image,
                             const HeightmapScale& scale, bool has_floor, double bottom) {
  HeightmapSurfaces made;
  const auto in_values = [&scale](double height) {
    return static_cast<int>(std::min(65'535.0, std::floor(height / scale.unit * kGreyRounding)));
  };
  const int width = in_values(scale.level_tolerance);
  std::map<int, long> counts;
  for (const int value : image.pixels) ++counts[value];
  const int lowest = has_floor ? width + 1 : 0;
  const double cell_area = scale.cell * scale.cell;
  const std::map<int, Band> bands = BandsOf(counts, lowest, width, kLeastMapArea / cell_area);
  if (bands.empty()) {
    made.refused = counts.rbegin()->first < lowest
                       ? "nothing of it is higher than level_tolerance_m above the floor"
                       : Formatted(
                             "has more than %zu levels (valid: a larger level_tolerance_m, "
                             "or an obstacle, as `halfstep scene` makes of it)",
                             kMostMapLevels);
    return made;
  }
  // Twice the top, and 1 more where something may stand; −1: floor.
  std::vector<int> values;
  long floor_cells = 0, level_cells = 0;
  values.reserve(image.pixels.size());
  for (const int pixel : image.pixels) {
    if (pixel < lowest) {
      ++floor_cells;
      values.push_back(-1);
      continue;
    }
    const Band& band = bands.at(pixel);
    level_cells += band.bears;
    values.push_back(2 * band.top + band.bears);
  }
  const std::vector<CellRectangle> rectangles =
      EqualRectangles(values, image.width, 0, kMostPrisms);
  if (rectangles.size() > kMostPrisms) {
    made.refused = Formatted(
        "is more than %zu rectangles of one height (valid: a larger "
        "level_tolerance_m, or fewer cells)",
        kMostPrisms);
    return made;
  }
  const auto x_of = [&](long column) {
    return scale.cell * (static_cast<double>(column) - 0.5 * static_cast<double>(image.width));
  };
  const auto y_of = [&](long row) {
    return scale.cell * (0.5 * static_cast<double>(image.height) - static_cast<double>(row));
  };
  for (const CellRectangle& r : rectangles) {
    Eigen::Matrix2Xd corners(2, 4);
    corners.row(0) << x_of(r.x), x_of(r.x + r.width), x_of(r.x + r.width), x_of(r.x);
    corners.row(1) << y_of(r.y + r.height), y_of(r.y + r.height), y_of(r.y), y_of(r.y);
    made.surfaces.push_back(
        {.name = name + "_" + std::to_string(made.surfaces.size() + 1),
         .polygon = (scale.X_WM.rotation() * corners).colwise() + scale.X_WM.position(),
         .height = scale.unit * (r.value / 2),
         .bottom = bottom,
         .bears = r.value % 2 == 1});
  }
  std::map<int, long> tops;
  for (const auto& [value, band] : bands) {
    if (band.bears) ++tops[band.top];
  }
  const long cells = static_cast<long>(image.pixels.size());
  made.told = Formatted(
      "heightmap: %ld of %ld cells lie on %zu levels, each as high as its highest "
      "cell, %ld are floor; nothing may stand on the other %ld",
      level_cells, cells, tops.size(), floor_cells, cells - level_cells - floor_cells);
  return made;
}

}  // namespace halfstep
