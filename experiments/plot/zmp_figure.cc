#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/plot/style.h"
#include "experiments/plot/subjects.h"
#include "experiments/plot/support_band.h"
#include "experiments/plot/ticks.h"

namespace halfstep::plot {
namespace {

using Eigen::Vector2d;

// A band as areas, one for each stretch of rows with the same soles on the floor.
std::vector<Area> BandAreas(const PlottedWalk& walk, const Vector2d& sole_size, int k,
                            double demanded, const Color& fill) {
  const std::vector<SupportBand> bands = SupportBands(walk, sole_size, k, demanded);
  const std::vector<std::string> support = walk.rows.Texts("support");
  std::vector<Area> areas;
  for (size_t begin = 0; begin < bands.size();) {
    size_t end = begin;
    while (end < bands.size() && support[end] == support[begin]) ++end;
    Area area{.name = "support", .corners = {}, .fill = fill};
    // Up to the next stretch, whose first row has the other soles.
    const double last = end < bands.size() ? walk.t[end] : walk.t[end - 1];
    for (size_t i = begin; i < end; ++i) area.corners.emplace_back(walk.t[i], bands[i].high);
    area.corners.emplace_back(last, bands[end - 1].high);
    area.corners.emplace_back(last, bands[end - 1].low);
    for (size_t i = end; i-- > begin;) area.corners.emplace_back(walk.t[i], bands[i].low);
    std::erase_if(area.corners, [](const Vector2d& p) { return !p.allFinite(); });
    if (area.corners.size() > 2) areas.push_back(std::move(area));
    begin = end;
  }
  return areas;
}

Panel Strip(const PlottedRun& run, const PlottedWalk& walk, int k) {
  Panel panel;
  const Vector2d size = run.place.robot.sole_size;
  panel.areas = BandAreas(walk, size, k, 0.0, style::Grey(0.91));
  if (walk.demanded_zmp && *walk.demanded_zmp > 0.0) {
    for (Area& area : BandAreas(walk, size, k, *walk.demanded_zmp, style::Grey(0.79))) {
      area.name = "support less what is demanded";
      panel.areas.push_back(std::move(area));
    }
  }
  const std::string axis = k == 0 ? "x" : "y";
  panel.lines.push_back({.name = walk.method + "/com_" + axis + "_m",
                         .points = walk.OverTime("com_" + axis + "_m"),
                         .stroke = {.color = style::kBlack, .width = 1.0},
                         .label = "CoM"});
  panel.lines.push_back({.name = walk.method + "/zmp_" + axis + "_m",
                         .points = walk.OverTime("zmp_" + axis + "_m"),
                         .stroke = {.color = style::kVermilion, .width = 0.9, .dash = {3.0, 1.3}},
                         .label = "ZMP"});
  return panel;
}

}  // namespace

std::vector<Row> ZmpRows(const PlottedRun& run) {
  std::vector<Row> rows;
  std::array<Extent, 2> extents;
  for (const PlottedWalk& walk : run.walks) {
    for (const int k : {0, 1}) {
      Panel panel = Strip(run, walk, k);
      if (k == 0 && run.compares()) panel.title = walk.Title();
      for (const Area& area : panel.areas) extents[static_cast<size_t>(k)].Add(area.corners, 1);
      for (const Line& line : panel.lines) extents[static_cast<size_t>(k)].Add(line.points, 1);
      rows.push_back({std::move(panel)});
    }
  }
  for (size_t i = 0; i < rows.size(); ++i) {
    Panel& panel = rows[i].front();
    panel.x = {.label = "time [s]", .low = 0.0, .high = run.duration()};
    panel.y = extents[i % 2].WithMargin(i % 2 == 0 ? "x [m]" : "y [m]", 0.03);
    panel.numbers_below = i + 1 == rows.size();
  }
  return rows;
}

}  // namespace halfstep::plot
