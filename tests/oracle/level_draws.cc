// Random walks over levels.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/oracle/nasty_draws.h"

namespace halfstep::oracle {
namespace {

// How far what touches the ground under a foot reaches from the sole's centre [m].
struct SoleReach {
  double front = 0, back = 0, aside = 0;
  explicit SoleReach(const PlainRobot& robot) {
    for (size_t leg = 0; leg < 2; ++leg) {
      for (const Eigen::Vector2d& p : Touching(robot, leg, 1e-3)) {
        front = std::max(front, p.x());
        back = std::max(back, -p.x());
        aside = std::max(aside, std::abs(p.y()));
      }
    }
  }
};

// Soles that are long beside the legs take longer steps from tread to tread, for which the waist
// has to be lower: a length that is 1 m for HRP-2 [m].
double Crouches(const PlainRobot& robot) {
  const SoleReach reach(robot);
  const double longer = (reach.front + reach.back) / (0.22 * robot.size());
  return robot.size() * longer * longer;
}

FloorPose Beside(const FloorPose& s, double x, double y, double yaw) {
  const double c = std::cos(s.yaw), sn = std::sin(s.yaw);
  return {s.x + c * x - sn * y, s.y + sn * x + c * y, s.yaw + yaw, 0};
}

FloorPose Middle(const WalkPlan& plan) {
  return {0.5 * (plan.start[0].x + plan.start[1].x), 0.5 * (plan.start[0].y + plan.start[1].y),
          plan.start[0].yaw, 0};
}

// Ground across the way, from `begin` to `end` along it [m], for the left and the right foot.
struct Row {
  double begin = 0, end = 0;
  std::array<double, 2> height{};
};

// Heights of rows: row 0 is where the walk starts.
std::vector<std::array<double, 2>> HeightsOf(SceneKind kind, size_t rows, double size, Draw* draw) {
  const double rise = size * draw->Uniform(0.015, 0.15) * (draw->Chance(0.6) ? 1 : -1);
  const std::array<double, 3> levels = {0, 0.6 * rise, size * draw->Uniform(-0.06, 0.06)};
  std::vector<std::array<double, 2>> heights = {{0, 0}};
  for (size_t k = 1; k < rows; ++k) {
    const double along = static_cast<double>(k);
    if (kind == SceneKind::kStairs) {
      heights.push_back({along * rise, along * rise});
    } else if (kind == SceneKind::kPlatforms) {
      const double h = k == 1 || draw->Chance(0.5) ? rise : 0;
      heights.push_back({h, h});
    } else {
      heights.push_back({levels[static_cast<size_t>(draw->Below(3))],
                         levels[static_cast<size_t>(draw->Below(3))]});
    }
  }
  return heights;
}

void AddSurface(const std::string& name, const Polygon& polygon, double height, double size,
                Draw* draw, PlainScene* scene) {
  if (scene->has_floor && height < 1e-9) return;  // the floor bears there
  PlainSurface surface{.name = name, .polygon = polygon, .height = height};
  if (!scene->has_floor) surface.thickness = size * draw->Uniform(0.02, 0.2);
  if (scene->has_floor && draw->Chance(0.3)) surface.thickness = height * draw->Uniform(0.2, 0.9);
  scene->surfaces.push_back(surface);
}

// How much to add to heights: above a floor the lowest is 0, or somewhat above; else anything.
double LiftOf(double lowest, double size, const PlainScene& scene, Draw* draw) {
  if (!scene.has_floor) return size * draw->Uniform(-0.5, 0.5);
  return draw->Chance(0.8) ? -lowest : size * draw->Uniform(0.01, 0.1) - lowest;
}

// Rows of ground as wide as drawn, as one flight where they are one.
void BuildRows(SceneKind kind, std::vector<Row> rows, const FloorPose& origin, double size,
               Draw* draw, PlainScene* scene) {
  double lowest = 0;
  for (const Row& row : rows) lowest = std::min({lowest, row.height[0], row.height[1]});
  const double lift = LiftOf(lowest, size, *scene, draw), half = size * draw->Uniform(0.4, 1);
  const double rise = rows[1].height[0];
  const auto corner = [&](double x, double y) {
    const FloorPose p = Beside(origin, x, y, 0);
    return Eigen::Vector2d(p.x, p.y);
  };
  const auto across = [&](const Row& row, double right, double left) {
    return Polygon{corner(row.begin, right), corner(row.end, right), corner(row.end, left),
                   corner(row.begin, left)};
  };
  if (kind == SceneKind::kStairs && draw->Chance(0.5)) {
    const double from = scene->has_floor && lift + lowest < 1e-9 ? 0 : lift + lowest;
    const bool up = rise > 0;
    // The lowest row is the floor, or a landing of its own.
    const Row& landing = up ? rows.front() : rows.back();
    AddSurface("landing", across(landing, -half, half), from, size, draw, scene);
    if (!up) {  // all treads are as long
      rows.front().begin = rows.front().end - (rows[1].end - rows[1].begin);
    }
    const FloorPose foot = Beside(origin, up ? rows[1].begin : rows.back().begin, 0, 0);
    PlainSurface flight{.name = "flight"};
    flight.count = static_cast<int>(rows.size()) - 1;
    flight.rise = std::abs(rise);
    flight.run = rows[1].end - rows[1].begin;
    flight.width = 2 * half;
    flight.at = {foot.x, foot.y, from};
    flight.yaw_deg = std::remainder(foot.yaw * 180 / std::numbers::pi + (up ? 0 : 180), 360);
    scene->surfaces.push_back(flight);
    return;
  }
  for (size_t k = 0; k < rows.size(); ++k) {
    const Row& row = rows[k];
    const std::string name = "row" + std::to_string(k);
    if (kind == SceneKind::kBlocks) {
      AddSurface(name + "l", across(row, 0, half), row.height[0] + lift, size, draw, scene);
      AddSurface(name + "r", across(row, -half, 0), row.height[1] + lift, size, draw, scene);
    } else {
      AddSurface(name, across(row, -half, half), row.height[0] + lift, size, draw, scene);
    }
  }
}

// Footsteps from row to row, in stairs and blocks step over step or both feet on each.
void WalkOverRows(SceneKind kind, const PlainRobot& robot, Draw* draw, WalkPlan* plan,
                  PlainScene* scene) {
  const SoleReach reach(robot);
  const double size = robot.size(), foothold = 0.005 * size, length = reach.front + reach.back;
  const FloorPose origin = Middle(*plan);
  std::vector<Row> rows(plan->steps.size() + 1 + static_cast<size_t>(draw->Below(2)));
  const auto heights = HeightsOf(kind, rows.size(), size, draw);
  const double run = length * draw->Uniform(1.03, 1.25) + 2 * foothold + 0.004 * size;
  double end = reach.front + foothold + size * draw->Uniform(0.0005, 0.03);
  for (size_t k = 0; k < rows.size(); ++k) {
    rows[k].height = heights[k];
    rows[k].begin = k == 0 ? -size * draw->Uniform(0.4, 1) : end;
    if (k > 0) {
      end += kind == SceneKind::kStairs ? run : run * draw->Uniform(1, 1.1);
      if (k + 1 == rows.size() && kind != SceneKind::kStairs) end += size * draw->Uniform(0, 0.5);
    }
    rows[k].end = end;
  }
  const bool both = draw->Chance(0.4);
  size_t row = 0;
  for (size_t j = 0; j < plan->steps.size(); ++j) {
    const auto foot = static_cast<size_t>(plan->steps[j].foot);
    if (!both || j % 2 == 0) ++row;
    const double yaw = (foot == 0 ? 1 : -1) * draw->Uniform(-0.03, 0.16);  // outwards most often
    const double margin =
        foothold + size * draw->Logarithmic(2e-4, 0.01) + reach.aside * std::abs(std::sin(yaw));
    const double low = rows[row].begin + reach.back + margin;
    double high = rows[row].end - reach.front - margin;
    if (j + 1 == plan->steps.size()) high = std::min(high, low + 0.1 * size);
    // Across an edge to ground of the same height.
    if (row + 1 < rows.size() && rows[row + 1].height[foot] == rows[row].height[foot]) {
      high = rows[row].end + 0.2 * length;
    }
    const double x = draw->Chance(0.4) ? low : draw->Uniform(low, std::max(low, high));
    const double y = 0.5 * robot.standing_width + size * draw->Uniform(-0.004, 0.03);
    plan->steps[j].landing = Beside(origin, x, foot == 0 ? y : -y, yaw);
  }
  BuildRows(kind, rows, origin, size, draw, scene);
}

// A stone under each footstep; those that meet are one level.
void PutStones(const PlainRobot& robot, Draw* draw, const WalkPlan& plan, PlainScene* scene) {
  const SoleReach reach(robot);
  const double size = robot.size(), foothold = 0.005 * size;
  std::vector<FloorPose> places = {plan.start[0], plan.start[1]};
  for (size_t j = 0; j < plan.steps.size(); ++j) places.push_back(plan.landing_of(j));
  std::vector<Polygon> stones;
  std::vector<size_t> level;
  std::vector<double> heights;
  const double most = size * draw->Uniform(0.01, 0.07);
  for (const FloorPose& p : places) {
    const auto more = [&] { return foothold + size * draw->Logarithmic(2e-4, 0.03); };
    const double front = reach.front + more(), back = reach.back + more();
    const double left = reach.aside + std::min(more(), 1.5 * foothold),
                 right = reach.aside + std::min(more(), 1.5 * foothold);
    stones.push_back(Standing({{front, left}, {-back, left}, {-back, -right}, {front, -right}},
                              {p.x, p.y, 0, p.yaw}));
    level.push_back(level.size());
    heights.push_back(draw->Uniform(-most, most));
  }
  for (size_t pass = 0; pass < stones.size(); ++pass) {
    for (size_t a = 0; a < stones.size(); ++a) {
      for (size_t b = 0; b < a; ++b) {
        if (Apart(stones[a], stones[b]) < 1e-3) level[a] = level[b] = std::min(level[a], level[b]);
      }
    }
  }
  double lowest = 0;
  for (const size_t l : level) lowest = std::min(lowest, heights[l]);
  const double lift = LiftOf(lowest, size, *scene, draw);
  for (size_t k = 0; k < stones.size(); ++k) {
    AddSurface("stone" + std::to_string(k), stones[k], heights[level[k]] + lift, size, draw, scene);
  }
}

// Heights of footsteps, as the ground has them; via points above them.
void FollowGround(const PlainScene& scene, WalkPlan* plan) {
  const PlainGround ground(scene.has_floor, scene.surfaces);
  const auto height = [&](const FloorPose& p) {
    return ground.HeightUnder({p.x, p.y}).value_or(0);
  };
  for (FloorPose& p : plan->start) p.z = height(p);
  std::array<double, 2> z = {plan->start[0].z, plan->start[1].z};
  for (size_t j = 0; j < plan->steps.size(); ++j) {
    PlannedStep& step = plan->steps[j];
    step.landing.z = height(plan->landing_of(j));
    const auto foot = static_cast<size_t>(step.foot);
    const double least = std::max(z[foot], step.landing.z) - z[1 - foot];
    // The via point is no lower than either footstep.
    step.via_height = std::max(step.via_height, 1.02 * least);
    double& scale = plan->height_scales[j];
    scale = std::max(scale, 1.01 * least / step.via_height);
    z[foot] = step.landing.z;
  }
}

void DrawForms(const PlainRobot& robot, Draw* draw, WalkPlan* plan) {
  const size_t n = plan->durations.size();
  for (double& T : plan->durations) T = draw->Uniform(1.6, 2.6);
  for (size_t i = 0; i + 1 < n; ++i) {  // rests stay
    double& overlap = plan->overlaps[i];
    if (overlap >= 0) overlap = NaturalBound(*plan, i) * draw->Uniform(0.3, 1);
  }
  plan->foot_delay = draw->Uniform(0.08, 0.2);
  for (double& delay : plan->foot_delays) delay = draw->Uniform(0.08, 0.2);
  for (FloorPose& move : plan->footsteps) move = {0.2 * move.x, 0.2 * move.y, 0.2 * move.yaw, 0};
  if (draw->Chance(0.5)) plan->crouch = Crouches(robot) * draw->Uniform(0, 0.03);
  if (draw->Chance(0.3)) return;
  const bool any = draw->Chance(0.2);
  for (size_t i = 0; i < n; ++i) {
    plan->rise_begins.push_back(any ? draw->Uniform(0, 0.75) : draw->Uniform(0.4, 0.6));
    plan->rise_ends.push_back(draw->Uniform(any ? 0.85 : 0.93, 1));
  }
}

}  // namespace

void DrawLevels(SceneKind kind, const PlainRobot& robot, Draw* draw, WalkPlan* plan,
                PlainScene* scene) {
  *plan = DrawPlan(robot, draw);
  const double size = robot.size();
  DrawForms(robot, draw, plan);
  scene->friction = draw->Uniform(0.3, 1);
  scene->has_floor = draw->Chance(kind == SceneKind::kStones ? 0.4 : 0.6);
  if (kind == SceneKind::kStones) {
    for (PlannedStep& step : plan->steps) {  // with one side ahead, so that stones are apart
      step.landing = Beside(step.landing, size * draw->Uniform(0, 0.1), 0, 0);
    }
    PutStones(robot, draw, *plan, scene);
  } else {
    WalkOverRows(kind, robot, draw, plan, scene);
  }
  // Above what the step needs.
  FollowGround(*scene, plan);
  std::array<double, 2> z = {plan->start[0].z, plan->start[1].z};
  for (size_t j = 0; j < plan->steps.size(); ++j) {
    PlannedStep& step = plan->steps[j];
    const auto foot = static_cast<size_t>(step.foot);
    const double least = std::max({z[foot], step.landing.z, z[1 - foot]}) - z[1 - foot];
    step.via_height = least + size * draw->Uniform(0.04, 0.14);
    plan->height_scales[j] = draw->Chance(0.3) ? 1 : draw->Uniform(0.75, 1);
    z[foot] = step.landing.z;
  }
  FollowGround(*scene, plan);
  if (draw->Chance(0.5)) return;
  const ClosedFormWalk walk(*plan);
  constexpr std::array kInTheWay = {SceneKind::kThinPlates, SceneKind::kNeedles,
                                    SceneKind::kPrimitives, SceneKind::kClosedMeshes,
                                    SceneKind::kClouds,     SceneKind::kMoving};
  const SceneKind obstacles = kInTheWay[static_cast<size_t>(draw->Below(6))];
  for (int k = 1 + draw->Below(3); k > 0; --k) {
    PlainObstacle o = DrawObstacle(obstacles, walk, size, draw);
    if (obstacles == SceneKind::kMoving) AddMotion(walk, size, draw, &o);
    o.name = "o" + std::to_string(k);
    scene->obstacles.push_back(std::move(o));
  }
  if (draw->Chance(0.2)) scene->no_step.push_back(DrawArea(walk, size, draw));
}

void CalmOverLevels(const PlainRobot& robot, WalkPlan* plan, PlainScene* scene) {
  Calm(plan);
  plan->crouch += 0.015 * Crouches(robot);
  for (PlannedStep& step : plan->steps) {
    step.via_height *= 0.9;  // rises become less
  }
  for (PlainSurface& surface : scene->surfaces) {
    surface.height *= 0.75;
    surface.rise *= 0.75;
    surface.at.z() *= 0.75;
  }
  FollowGround(*scene, plan);
}

}  // namespace halfstep::oracle
