#include "experiments/config/planning_config.h"

#include <cmath>

namespace halfstep {
namespace {

struct PartName {
  const char* name;
  GoalPart part;
};
constexpr PartName kParts[] = {{"either_foot", GoalPart::kEitherFoot},
                               {"left_foot", GoalPart::kLeftFoot},
                               {"right_foot", GoalPart::kRightFoot},
                               {"mid_feet", GoalPart::kMidFeet}};

struct NamedCost {
  const char* name;
  CostKind kind;
};
constexpr NamedCost kCosts[] = {{"steps", CostKind::kSteps},
                                {"raw_duration", CostKind::kRawDuration},
                                {"smoothed_duration", CostKind::kSmoothedDuration}};

constexpr const char* kBest = "best";

template <typename Table>
std::vector<std::string> NamesOf(const Table& table) {
  std::vector<std::string> names;
  for (const auto& row : table) names.emplace_back(row.name);
  return names;
}

void DeclareCells(Fields& fields, PoseCells* cells) {
  fields.Number("cell_m", &cells->position,
                {.meaning = "two states nearer than about this count as one",
                 .unit = "m",
                 .min = 0.002,
                 .max = 0.5});
  fields.Number("cell_yaw_rad", &cells->yaw,
                {.meaning = "the same of their yaws", .unit = "rad", .min = 0.01, .max = 1});
}

void DeclareBoundingBox(Fields& fields, BoundingBoxOptions* o) {
  const auto size = [&](const char* key, double* value, const char* meaning) {
    fields.Number(key, value, {.meaning = meaning, .unit = "m", .min = 0.05, .max = 5});
  };
  size("length_m", &o->box.length, "of the box around the walking robot, along its x");
  size("width_m", &o->box.width, "along its y");
  size("height_m", &o->box.height, "from the floor");
  size("feet_apart_m", &o->box.feet_apart, "of feet beside each other");
  fields.Number(
      "spacing_m", &o->grid.spacing,
      {.meaning = "of the grid that the box moves on", .unit = "m", .min = 0.01, .max = 1});
  fields.Integer("yaws", &o->grid.yaws, {.meaning = "of a full turn", .min = 4, .max = 360});
  fields.Number("corridor_m", &o->corridor,
                {.meaning = "how far footsteps may stray from the way of the box",
                 .unit = "m",
                 .min = 0.05,
                 .max = 5});
}

}  // namespace

GoalRegion GoalConfig::Region() const {
  GoalRegion region;
  for (const PartName& row : kParts) {
    if (part == row.name) region.part = row.part;
  }
  region.X_WG = X_WG;
  region.radius = radius;
  if (box.size() == 2) region.box = Eigen::Vector2d(box[0], box[1]);
  region.yaw_tolerance = yaw_tolerance;
  return region;
}

StepCost PlannerConfig::Cost(bool in_time) const {
  StepCost step_cost = estimate;
  for (const NamedCost& row : kCosts) {
    if (CostName(in_time) == row.name) step_cost.kind = row.kind;
  }
  return step_cost;
}

std::string PlannerConfig::CostName(bool in_time) const {
  if (!cost.empty()) return cost;
  if (name != kBest) return "steps";
  return in_time ? "raw_duration" : "smoothed_duration";
}

Termination PlannerConfig::Enough(bool in_time) const {
  constexpr std::int64_t kUnimproved = 500;
  constexpr double kInTime = 2.0;  // times the work, since half-steps cost more there
  const bool best = name == kBest;
  if (unimproved_nodes == 0.0) return AtFirstPlan();
  std::vector<Termination> all;
  if (best) all.push_back(WhenPlannedAfter((in_time ? kInTime : 1.0) * improving_effort));
  if (unimproved_nodes || !best) {
    all.push_back(WhenNotImprovedFor(unimproved_nodes ? static_cast<std::int64_t>(*unimproved_nodes)
                                                      : kUnimproved));
  }
  return AnyOf(std::move(all));
}

void DeclareGoal(Fields& fields, GoalConfig* c) {
  fields.Text("part", &c->part,
              {.meaning = "what shall be in the region", .choices = NamesOf(kParts)});
  const NumberSpec position{.meaning = "of the region's centre in the world",
                            .unit = "m",
                            .min = -1000,
                            .max = 1000,
                            .required = true};
  fields.Number("x_m", &c->X_WG.x, position);
  fields.Number("y_m", &c->X_WG.y, position);
  fields.Number("yaw_deg", &c->X_WG.yaw,
                {.meaning = "turns the box; the middle of the yaws, modulo a turn",
                 .unit = "deg",
                 .min = -3600,
                 .max = 3600});
  fields.Number("radius_m", &c->radius,
                {.meaning = "of the disc", .unit = "m", .min = 0, .max = 1000});
  fields.Numbers("box_m", &c->box, 0,
                 {.meaning = "edge lengths of a box in place of the disc; []: the disc",
                  .unit = "m",
                  .min = 0,
                  .max = 1000});
  if (c->box.size() != 0 && c->box.size() != 2) {
    fields.Complain("box_m", "has " + std::to_string(c->box.size()) +
                                 " numbers (valid: [length, width], or [])");
  }
  if (c->box.size() == 2 && (c->box[0] == 0.0 || c->box[1] == 0.0)) {
    fields.Complain("box_m", "has an edge of 0: no sole lands exactly on a line (valid: > 0)");
  }
  if (c->box.empty() && c->radius == 0.0) {
    fields.Complain("radius_m", "is 0: no sole lands exactly on a point (valid: > 0, or a box_m)");
  }
  fields.OptionalNumber(
      "yaw_tolerance_deg", &c->yaw_tolerance,
      {.meaning = "either way; none: any yaw", .unit = "deg", .min = 0, .max = 180});
  fields.Text("level", &c->level,
              {.meaning = "on uneven ground: the surface on which the feet shall stand, or `floor`",
               .otherwise = "any",
               .left_out_empty = true});
}

void DeclarePlanner(Fields& fields, PlannerConfig* c) {
  fields.Text("name", &c->name,
              {.meaning = "which planner; in episodes `rrt` by default",
               .choices = c->known.Names(),
               .listed_by = "halfstep list planners"});
  fields.Text("cost", &c->cost,
              {.meaning = "of a plan; the last is an estimate, which plans in time cannot have",
               .choices = NamesOf(kCosts),
               .otherwise = "smoothed_duration of `best` (in time raw_duration), else steps",
               .left_out_empty = true});
  fields.Text(
      "free_by", &c->free_by,
      {.meaning = "what says that a half-step is free: baked volumes, or its proof",
       .choices = {"volumes", "certificates"},
       .otherwise = "certificates on levels where nothing moves or planned in time, else volumes",
       .left_out_empty = true});
  fields.Text("moving", &c->moving,
              {.meaning = "where obstacles that move count: where they are at the time, or "
                          "everywhere that they ever are",
               .choices = {"in_time", "everywhere"},
               .otherwise = "in_time where the planner can",
               .left_out_empty = true});
  fields.Integer("max_nodes", &c->max_nodes,
                 {.meaning = "after so many nodes the search ends", .min = 0, .max = 1000000000});
  fields.OptionalNumber(
      "unimproved_nodes", &c->unimproved_nodes,
      {.meaning = "it ends when so many did not improve the plan; 0: at the first plan; none: of "
                  "`best` it goes by improving_effort, of others 500",
       .min = 0,
       .max = 1000000000});
  if (c->unimproved_nodes && *c->unimproved_nodes != std::floor(*c->unimproved_nodes)) {
    fields.Complain("unimproved_nodes", "has a fraction (valid: a whole number, or none)");
  }
  fields.Number("improving_effort", &c->improving_effort,
                {.meaning = "`best` looks for better plans until this much work is used (in time "
                            "twice that), or three times what the first plan took",
                 .min = 0.001,
                 .max = 86400});
  fields.Number("effort", &c->effort,
                {.meaning = "it ends after so much work; 1 is about a second of one core of 2026",
                 .min = 0.001,
                 .max = 86400});
  fields.Number(
      "deadline_s", &c->deadline,
      {.meaning = "emergency stop by the clock, whose plan is not the same twice; 0: none",
       .unit = "s",
       .min = 0,
       .max = 86400});
  fields.Integer("max_refusals", &c->max_refusals,
                 {.meaning = "so many plans may fail to be certified, then planning ends",
                  .min = 1,
                  .max = 1000});
  fields.Numbers(
      "workspace_m", &c->workspace, 0,
      {.meaning = "x_min, y_min, x_max, y_max of supporting soles; []: 2 m around start and goal",
       .unit = "m",
       .min = -1000,
       .max = 1000});
  const auto& w = c->workspace;
  if (!w.empty() && (w.size() != 4 || !(w[0] < w[2]) || !(w[1] < w[3]))) {
    fields.Complain("workspace_m", "is no box (valid: [x_min, y_min, x_max, y_max], or [])");
  }
  fields.Group(
      "estimate", {.meaning = "how the cost `smoothed_duration` of a step is made up"},
      [&](Fields& f) {
        f.Number("step_s", &c->estimate.step_time,
                 {.meaning = "of any step", .unit = "s", .min = 0.01, .max = 100});
        f.Number(
            "per_metre_s", &c->estimate.time_per_metre,
            {.meaning = "for each metre that its foot goes", .unit = "s/m", .min = 0, .max = 100});
        f.Number("per_radian_s", &c->estimate.time_per_radian,
                 {.meaning = "for each radian that its foot turns",
                  .unit = "s/rad",
                  .min = 0,
                  .max = 100});
      });
  fields.Group("rrt", {.meaning = "options of `rrt`, and of the trees of `best`"}, [&](Fields& f) {
    f.Number("goal_bias", &c->options.rrt.goal_bias,
             {.meaning = "share of the samples in the goal", .min = 0, .max = 1});
    DeclareCells(f, &c->options.rrt.cells);
  });
  fields.Group(
      "astar", {.meaning = "options of `astar` and `astar/classic`; `best` has the cells"},
      [&](Fields& f) {
        f.Numbers(
            "weights", &c->options.astar.weights, 0,
            {.meaning = "of the cost to go, one search after the other", .min = 1, .max = 1000});
        DeclareCells(f, &c->options.astar.cells);
      });
  if (c->options.astar.weights.empty()) {
    fields.Complain("astar", "weights: there are none (valid: numbers from 1 on)");
  }
  fields.Group("bounding_box", {.meaning = "options of `bounding_box`"},
               [&](Fields& f) { DeclareBoundingBox(f, &c->options.bounding_box); });
}

void DeclareStepSet(Fields& fields, StepGrid* g) {
  const auto bound = [&](const char* key, double* value, const char* meaning) {
    fields.Number(key, value, {.meaning = meaning, .unit = "m", .min = -2, .max = 2});
  };
  bound("x_min_m", &g->x_min, "places of the landing sole beside a left support that are tried");
  bound("x_max_m", &g->x_max, "not below x_min_m");
  bound("y_min_m", &g->y_min, "the same across");
  bound("y_max_m", &g->y_max, "not below y_min_m");
  if (g->x_min > g->x_max) fields.Complain("x_max_m", "is below x_min_m (valid: not below it)");
  if (g->y_min > g->y_max) fields.Complain("y_max_m", "is below y_min_m (valid: not below it)");
  fields.Number("spacing_m", &g->spacing,
                {.meaning = "of x and y, from their least", .unit = "m", .min = 0.005, .max = 1});
  fields.Numbers("yaws_rad", &g->yaws, 0,
                 {.meaning = "of the landing sole", .unit = "rad", .min = -3, .max = 3});
  if (g->yaws.empty()) fields.Complain("yaws_rad", "there are none (valid: at least one)");
}

void DeclareSweptVolumes(Fields& fields, SweptVolumesConfig* c) {
  fields.Number("cell_m", &c->options.cell,
                {.meaning = "edge of the cells that a volume is made of",
                 .unit = "m",
                 .min = 0.001,
                 .max = 0.1});
  fields.Number("displacement_m", &c->options.displacement,
                {.meaning = "what a body may move within an interval of time of the bake",
                 .unit = "m",
                 .min = 1e-4,
                 .max = 0.1});
  fields.Text("cache", &c->cache,
              {.meaning = "folder of the baked volumes, relative to the config",
               .otherwise = "the user's cache folder"});
}

}  // namespace halfstep
