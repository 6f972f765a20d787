#include <algorithm>

#include "experiments/plot/silhouette.h"
#include "experiments/plot/style.h"
#include "experiments/plot/subjects.h"
#include "planner/scene/solid_body.h"
#include "wpg/geometry/support_polygon.h"

namespace halfstep::plot {
namespace {

using Eigen::Vector2d;

constexpr double kAround = 0.08;         // of the walk, that is shown [m]
constexpr size_t kMostNames = 4;         // of obstacles and areas that are written
constexpr size_t kMostPolygons = 40000;  // of obstacles that are drawn

std::vector<Vector2d> CornersOf(const Eigen::Matrix2Xd& polygon) {
  std::vector<Vector2d> corners;
  for (const auto& corner : polygon.colwise()) corners.emplace_back(corner);
  return corners;
}

/// A sole on the floor, in the order of landings.
struct Landing {
  double t = 0.0;  // [s]
  Side side = Side::kLeft;
  Pose2 place;
  std::string number;  // as footsteps.csv counts; L and R at the start
};

std::vector<Landing> LandingsOf(const PlottedWalk& walk) {
  std::vector<Landing> landings;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const std::vector<bool> stands = walk.Stands(side);
    const std::vector<Pose2> soles = walk.Soles(side);
    for (size_t i = 0; i < soles.size(); ++i) {
      if (!stands[i] || (i > 0 && stands[i - 1])) continue;
      landings.push_back(
          {walk.t[i], side, soles[i], i == 0 ? (side == Side::kLeft ? "L" : "R") : ""});
    }
  }
  std::ranges::stable_sort(landings, {}, &Landing::t);
  for (size_t i = 2; i < landings.size(); ++i) landings[i].number = std::to_string(i - 1);
  return landings;
}

// Fills first, so that all outlines show where soles stood on the same place.
std::vector<Area> Footprints(const PlottedWalk& walk, const Eigen::Vector2d& size) {
  std::vector<Area> fills, outlines;
  for (const Landing& landing : LandingsOf(walk)) {
    const bool left = landing.side == Side::kLeft;
    const Color color = style::Of(landing.side);
    Area area{.name = std::string(halfstep::Name(landing.side)) + " footprint",
              .corners = CornersOf(SoleCorners(landing.place, size)),
              .fill = style::Lighter(color, left ? 0.75 : 0.9)};
    fills.push_back(area);
    area.fill.reset();
    area.outline = Stroke{.color = color, .width = 0.6};
    area.label = landing.number;
    area.label_inside = true;
    area.ink = style::Grey(0.15);
    outlines.push_back(std::move(area));
  }
  fills.insert(fills.end(), outlines.begin(), outlines.end());
  return fills;
}

/// The window that panels of all walks show.
struct Window {
  Extent x, y;
  void Add(const Area& area) {
    x.Add(area.corners, 0);
    y.Add(area.corners, 1);
  }
  void Add(const Line& line) {
    x.Add(line.points, 0);
    y.Add(line.points, 1);
  }
};

// Whether any of a polygon may be in the window.
bool Meets(const Panel& panel, const std::vector<Vector2d>& corners) {
  Extent x, y;
  x.Add(corners, 0);
  y.Add(corners, 1);
  return x.high >= panel.x.low && x.low <= panel.x.high && y.high >= panel.y.low &&
         y.low <= panel.y.high;
}

void AddObstacle(const Obstacle& obstacle, Panel* panel, std::vector<size_t>* named) {
  const std::vector<std::vector<Vector2d>> polygons = Silhouette(obstacle, 0, 1);
  bool first = true;
  for (const std::vector<Vector2d>& corners : polygons) {
    if (!Meets(*panel, corners) || panel->areas.size() > kMostPolygons) continue;
    if (first) named->push_back(panel->areas.size());
    first = false;
    Area area{.name = obstacle.name, .corners = corners, .fill = style::Grey(0.6)};
    if (polygons.size() == 1) area.outline = Stroke{.color = style::Grey(0.3), .width = 0.5};
    area.ink = style::Grey(0.15);
    panel->areas.push_back(std::move(area));
  }
}

// Where a known motion leads an obstacle's frame.
void AddMotion(const Obstacle& obstacle, Panel* panel) {
  if (obstacle.motion.waypoints.empty()) return;
  Line way{.name = obstacle.name + " path",
           .points = {obstacle.X_WO.translation().head<2>()},
           .stroke = {.color = style::Grey(0.3), .width = 0.6, .dash = {1.0, 1.5}}};
  for (const ObstacleMotion::Waypoint& waypoint : obstacle.motion.waypoints) {
    way.points.push_back(waypoint.translation.head<2>());
  }
  panel->lines.push_back(std::move(way));
}

// Ground, areas and obstacles of the scene that the panel shows.
void AddScene(const Scene& scene, Panel* panel) {
  std::vector<size_t> named;
  for (const GroundSolid& solid : scene.ground->Solids()) {
    std::vector<Vector2d> corners = CornersOf(solid.polygon);
    if (!Meets(*panel, corners)) continue;
    named.push_back(panel->areas.size());
    panel->areas.push_back({.name = solid.name,
                            .corners = std::move(corners),
                            .fill = style::Grey(solid.bears ? 0.93 : 0.7),
                            .outline = Stroke{.color = style::Grey(0.5), .width = 0.5},
                            .ink = style::Grey(0.15)});
  }
  for (size_t i = 0; i < scene.no_step.size(); ++i) {
    std::vector<Vector2d> corners = CornersOf(scene.no_step[i]);
    if (!Meets(*panel, corners)) continue;
    Area area{.name = "no-step area " + std::to_string(i + 1),
              .corners = std::move(corners),
              .fill = style::Grey(0.95),
              .outline = Stroke{.color = style::Grey(0.55), .width = 0.4},
              .hatched = true,
              .ink = style::Grey(0.15)};
    if (i == 0) area.label = "no step";
    panel->areas.push_back(std::move(area));
  }
  for (const Obstacle& obstacle : scene.obstacles) {
    AddObstacle(obstacle, panel, &named);
    AddMotion(obstacle, panel);
  }
  if (named.size() > kMostNames) return;
  for (const size_t i : named) panel->areas[i].label = panel->areas[i].name;
}

}  // namespace

std::vector<Row> WalkRows(const PlottedRun& run) {
  const Eigen::Vector2d size = run.place.robot.sole_size;
  std::vector<Panel> panels;
  Window window;
  for (const PlottedWalk& walk : run.walks) {
    Panel& panel = panels.emplace_back();
    if (run.compares()) panel.title = walk.Title();
    panel.equal = true;
    panel.height = 0.0;
    panel.areas = Footprints(walk, size);
    panel.lines.push_back({.name = walk.method + "/zmp",
                           .points = walk.Path("zmp_x_m", "zmp_y_m"),
                           .stroke = style::ZmpLine(),
                           .label = "ZMP"});
    panel.lines.push_back({.name = walk.method + "/com",
                           .points = walk.Path("com_x_m", "com_y_m"),
                           .stroke = style::ComLine(),
                           .label = "CoM"});
    for (const Area& area : panel.areas) window.Add(area);
    for (const Line& line : panel.lines) window.Add(line);
  }
  window.x.low -= kAround, window.x.high += kAround;
  window.y.low -= kAround, window.y.high += kAround;
  for (Panel& panel : panels) {
    panel.x = window.x.WithMargin("x [m]", 0.0);
    panel.y = window.y.WithMargin("y [m]", 0.0);
    const std::vector<Area> footprints = std::move(panel.areas);
    panel.areas.clear();
    AddScene(run.place.scene, &panel);
    panel.areas.insert(panel.areas.end(), footprints.begin(), footprints.end());
  }
  return Compared(std::move(panels), 0.9);
}

}  // namespace halfstep::plot
