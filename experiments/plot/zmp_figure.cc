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

// A band as one area; where other soles begin to stand its edges are upright.
Area BandArea(const PlottedWalk& walk, const Vector2d& sole_size, int k, double demanded) {
  const std::vector<SupportBand> bands = SupportBands(walk, sole_size, k, demanded);
  const std::vector<std::string> support = walk.rows.Texts("support");
  std::vector<Vector2d> upper, lower;
  for (size_t i = 0; i < bands.size(); ++i) {
    if (!std::isfinite(bands[i].low)) continue;
    if (i > 0 && support[i] != support[i - 1] && !upper.empty()) {
      upper.emplace_back(walk.t[i], upper.back().y());
      lower.emplace_back(walk.t[i], lower.back().y());
    }
    upper.emplace_back(walk.t[i], bands[i].high);
    lower.emplace_back(walk.t[i], bands[i].low);
  }
  upper.insert(upper.end(), lower.rbegin(), lower.rend());
  return {.name = "support", .corners = std::move(upper)};
}

Panel Strip(const PlottedRun& run, const PlottedWalk& walk, int k) {
  Panel panel;
  const Vector2d size = run.place.robot.sole_size;
  panel.areas.push_back(BandArea(walk, size, k, 0.0));
  panel.areas.back().fill = style::Grey(0.9);
  if (walk.demanded_zmp && *walk.demanded_zmp > 0.0) {
    panel.areas.push_back(BandArea(walk, size, k, *walk.demanded_zmp));
    panel.areas.back().name = "demanded";
    panel.areas.back().fill = style::Grey(0.8);
  }
  const std::string axis = k == 0 ? "x" : "y";
  panel.lines.push_back({.name = walk.method + "/zmp_" + axis + "_m",
                         .points = walk.OverTime("zmp_" + axis + "_m"),
                         .stroke = style::ZmpLine(),
                         .label = "ZMP"});
  panel.lines.push_back({.name = walk.method + "/com_" + axis + "_m",
                         .points = walk.OverTime("com_" + axis + "_m"),
                         .stroke = style::ComLine(),
                         .label = "CoM"});
  if (k == 1) {
    panel.areas.back().label = "support";
    panel.areas.back().ink = style::Grey(0.35);
  }
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
