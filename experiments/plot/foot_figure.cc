#include <algorithm>

#include "experiments/plot/silhouette.h"
#include "experiments/plot/style.h"
#include "experiments/plot/subjects.h"
#include "planner/scene/solid_body.h"

namespace halfstep::plot {
namespace {

using Eigen::Vector2d;

constexpr double kCentimetres = 100.0;  // in a metre
constexpr double kStill = 0.5;          // the least way of a sole that is drawn [cm]
constexpr double kLeastHeight = 50.0;   // of panels from the side [pt]
constexpr double kBeside = 0.03;        // an obstacle so near to a sole's way is in it [m]

std::string Column(Side side, const std::string& what) {
  return std::string(halfstep::Name(side)) + "_foot_" + what;
}

// The coordinate along which the soles go farther: 'x' or 'y'.
std::string Ahead(const PlottedRun& run) {
  Extent x, y;
  for (const PlottedWalk& walk : run.walks) {
    for (const Side side : {Side::kLeft, Side::kRight}) {
      for (const Pose2& place : walk.Footprints(side)) x.Add(place.x), y.Add(place.y);
    }
  }
  return x.high - x.low >= y.high - y.low ? "x" : "y";
}

Line SoleLine(const PlottedWalk& walk, Side side, const std::string& column, double factor) {
  return {.name = walk.method + "/" + Column(side, column),
          .points = walk.OverTime(Column(side, column), factor),
          .stroke = style::LineOf(side),
          .label = std::string(halfstep::Name(side))};
}

// Whether what bounds hold, seen from above, is in the way of a sole.
bool InTheWay(const PlottedRun& run, const Eigen::AlignedBox3d& bounds) {
  const double reach = 0.5 * run.place.robot.sole_size.norm() + kBeside;
  const Eigen::AlignedBox2d above(bounds.min().head<2>(), bounds.max().head<2>());
  for (const PlottedWalk& walk : run.walks) {
    for (const Side side : {Side::kLeft, Side::kRight}) {
      for (const Pose2& sole : walk.Soles(side)) {
        if (above.squaredExteriorDistance(sole.position()) < reach * reach) return true;
      }
    }
  }
  return false;
}

void AddSilhouette(const PlottedRun& run, const Obstacle& obstacle, int ahead, double grey,
                   std::vector<Area>* areas) {
  if (!InTheWay(run, BoundsOf(obstacle.shape, obstacle.X_WO))) return;
  for (std::vector<Vector2d>& corners : Silhouette(obstacle, ahead, 2)) {
    for (Vector2d& corner : corners) corner *= kCentimetres;
    areas->push_back({.name = obstacle.name,
                      .corners = std::move(corners),
                      .fill = style::Grey(grey),
                      .ink = style::Grey(0.15)});
  }
}

// Solids of the ground and obstacles that soles go over or beside.
std::vector<Area> InTheWayFromTheSide(const PlottedRun& run, int ahead) {
  std::vector<Area> areas;
  for (const GroundSolid& solid : run.place.scene.ground->Solids()) {
    AddSilhouette(run, BodyOf(solid), ahead, 0.88, &areas);
  }
  for (const Obstacle& obstacle : run.place.scene.obstacles) {
    AddSilhouette(run, obstacle, ahead, 0.6, &areas);
  }
  if (areas.size() == 1) areas.front().label = areas.front().name;
  return areas;
}

}  // namespace

std::vector<Row> FootRows(const PlottedRun& run) {
  const std::string ahead = Ahead(run);
  Extent height, place;
  std::vector<Row> rows;
  for (const PlottedWalk& walk : run.walks) {
    Panel above, forward;
    if (run.compares()) above.title = walk.Title();
    for (const Side side : {Side::kLeft, Side::kRight}) {
      above.lines.push_back(SoleLine(walk, side, "z_m", kCentimetres));
      forward.lines.push_back(SoleLine(walk, side, ahead + "_m", 1.0));
      height.Add(above.lines.back().points, 1);
      place.Add(forward.lines.back().points, 1);
    }
    above.numbers_below = false;
    rows.push_back({std::move(above)});
    rows.push_back({std::move(forward)});
  }
  for (size_t i = 0; i < rows.size(); ++i) {
    Panel& panel = rows[i].front();
    panel.x = {.label = "time [s]", .low = 0.0, .high = run.duration()};
    panel.y = i % 2 == 0 ? height.WithMargin("height [cm]") : place.WithMargin(ahead + " [m]");
    panel.numbers_below = i + 1 == rows.size();
  }
  return rows;
}

std::vector<Row> SideRows(const PlottedRun& run) {
  const std::string ahead = Ahead(run);
  Panel common{.areas = InTheWayFromTheSide(run, ahead == "x" ? 0 : 1)};
  Extent x, z;
  z.Add(0.0);
  std::vector<Panel> panels;
  for (const PlottedWalk& walk : run.walks) {
    Panel& panel = panels.emplace_back(common);
    if (run.compares()) panel.title = walk.Title();
    for (const Side side : {Side::kLeft, Side::kRight}) {
      Line line{.name = walk.method + "/" + Column(side, "z_m"),
                .points = walk.Path(Column(side, ahead + "_m"), Column(side, "z_m"), kCentimetres),
                .stroke = style::LineOf(side),
                .label = std::string(halfstep::Name(side))};
      Extent way;
      way.Add(line.points, 0);
      if (way.high - way.low < kStill) continue;
      x.Add(line.points, 0);
      z.Add(line.points, 1);
      panel.lines.push_back(std::move(line));
    }
  }
  for (Panel& panel : panels) {
    panel.x = x.WithMargin(ahead + " of the sole's centre [cm]");
    panel.y = z.WithMargin("height [cm]");
    panel.y.low = std::min(z.low, 0.0);
    panel.equal = true;  // where that is high enough
    panel.height = kLeastHeight;
  }
  return Compared(std::move(panels), 0.5);
}

}  // namespace halfstep::plot
