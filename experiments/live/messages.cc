#include "experiments/live/messages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <variant>

#include "experiments/live/promise_words.h"
#include "experiments/report/report_place.h"
#include "experiments/tables/result_tables.h"
#include "wpg/geometry/side.h"
#include "wpg/nth.h"

namespace halfstep {

using nlohmann::json;

namespace {

json OrNull(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json RowJson(const RobotModel& robot, const SuperposedWalk& executed, double t) {
  json row = json::array();
  for (const MotionCell& cell : MotionRow(robot, executed, t)) {
    if (const auto* number = std::get_if<double>(&cell)) {
      row.push_back(OrNull(*number));
    } else {
      std::visit([&row](const auto& value) { row.push_back(value); }, cell);
    }
  }
  return row;
}

json ObstacleJson(const Obstacle& obstacle) {
  const Eigen::Vector3d p = obstacle.X_WO.translation();
  const Eigen::Quaterniond q(obstacle.X_WO.linear());
  const ObstacleMotion& motion = obstacle.motion;
  return {{"name", obstacle.name},
          {"xyz_m", {p.x(), p.y(), p.z()}},
          {"quaternion_wxyz", {q.w(), q.x(), q.y(), q.z()}},
          {"error_m", motion.error},
          {"speed_m_s", motion.speed},
          {"horizon_s", OrNull(motion.horizon)}};
}

json FootstepJson(Side side, const Foothold& X_WF, bool has_heights) {
  json footstep = {{"foot", Name(side)}, {"x_m", X_WF.x}, {"y_m", X_WF.y}, {"yaw_rad", X_WF.yaw}};
  if (has_heights) footstep["z_m"] = X_WF.height;
  return footstep;
}

// Of a tail, without the soles at its start.
json FootstepsJson(const HalfStepSequence& sequence, bool is_tail) {
  json footsteps = json::array();
  const bool has_heights = HasHeights(sequence);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    if (is_tail) break;
    footsteps.push_back(FootstepJson(side, Nth(sequence.start, Index(side)), has_heights));
  }
  for (int step = 0; step < sequence.num_steps(); ++step) {
    const PlacedHalfStep& down = Nth(sequence.half_steps, 2 * step + 1);
    footsteps.push_back(
        FootstepJson(down.half_step.swing(), down.X_WS * down.half_step.X_SF, has_heights));
  }
  return footsteps;
}

// Of ground with levels, the height of what is under the middle of the goal [m].
std::optional<double> GoalHeight(const World& world) {
  const Ground& ground = *world.scene.ground;
  if (ground.OnlyLevel()) return std::nullopt;
  if (world.goal.height) return world.goal.height;
  const Eigen::Matrix2Xd spot{{1e-3, 0.0, -1e-3}, {0.0, 1e-3, -1e-3}};
  const auto level =
      ground.LevelUnder(spot, world.goal.X_WG, std::numeric_limits<double>::infinity());
  return level ? std::optional(level->height) : std::nullopt;
}

json GoalJson(const World& world) {
  json goal = {{"x_m", world.goal.X_WG.x}, {"y_m", world.goal.X_WG.y}};
  if (const auto z = GoalHeight(world)) goal["z_m"] = *z;
  return goal;
}

}  // namespace

json HelloMessage(const LiveConfig& config, const RobotModel& robot, const Scene& scene,
                  const std::vector<std::string>& spare) {
  json columns = json::array(), obstacles = json::array();
  for (const CsvColumn& column : MotionColumns(robot)) columns.push_back(column.name);
  for (const Obstacle& obstacle : scene.obstacles) {
    obstacles.push_back({{"name", obstacle.name}, {"speed_m_s", obstacle.motion.speed}});
  }
  return {{"type", "hello"},
          {"protocol", kProtocol},
          {"name", config.experiment.name},
          {"robot", robot.name},
          {"columns", columns},
          {"control_period_s", config.live.period},
          {"sensing_period_s", config.live.sensing.period},
          {"source", config.live.sensing.source},
          {"obstacles", obstacles},
          {"spare", spare},
          {"areas", scene.no_step.size()},
          {"goal_radius_m", config.experiment.goal.radius}};
}

json WaitingMessage(std::string_view reason) { return {{"type", "waiting"}, {"reason", reason}}; }

json WorldMessage(const World& world, double known) {
  json areas = json::array(), obstacles = json::array();
  for (const size_t area : world.areas) areas.push_back(area + 1);
  for (const Obstacle& obstacle : world.scene.obstacles) {
    obstacles.push_back(ObstacleJson(obstacle));
  }
  json message = {{"type", "world"},
                  {"world", world.version},
                  {"known_s", known},
                  {"measured_s", world.measured_at},
                  {"sound_since", world.sound_since},
                  {"goal", GoalJson(world)},
                  {"areas", areas},
                  {"obstacles", obstacles}};
  if (world.course) message["commanded"] = world.course->Text();
  return message;
}

json WalkMessage(const ExecutedWalk& walk, size_t index) {
  const WalkTail& tail = walk.tail;
  const HomotopyParameters& of = tail.plan.parameters;
  json half_steps = json::array();
  double start = tail.begin;
  for (size_t i = 0; i < of.durations.size(); ++i) {
    half_steps.push_back({{"start_s", start}, {"end_s", start + of.durations[i]}});
    if (i < of.overlaps.size()) start += of.durations[i] - of.overlaps[i];
  }
  return {{"type", "walk"},
          {"walk", index},
          {"handed_over_s", walk.t},
          {"kind", Name(walk.kind)},
          {"reason", walk.reason},
          {"first_changed", walk.first_changed + 1},
          {"asked_s", walk.asked},
          {"measured_s", walk.measured},
          {"check_s", walk.check_s},
          {"plan_s", walk.plan_s},
          {"smooth_s", walk.smooth_s},
          {"duration_s", tail.end()},
          {"same", tail.first == 0 ? 0 : tail.first / 2 + 2},
          {"footsteps", FootstepsJson(tail.plan.sequence, tail.first > 0)},
          {"half_steps", half_steps}};
}

void MakeWhole(json before, json* message) {
  const size_t same = (*message)["same"].get<size_t>();
  if (same == 0) return;
  (*message)["same"] = 0;
  const auto follow = [&](const char* key, size_t kept) {
    json& all = before[key];
    all.erase(all.begin() + static_cast<json::difference_type>(kept), all.end());
    for (json& one : (*message)[key]) all.push_back(std::move(one));
    (*message)[key] = std::move(all);
  };
  follow("footsteps", same);
  follow("half_steps", 2 * (same - 2));
}

json GrantMessage(const EpisodeGrant& grant, size_t index) {
  return {{"type", "grant"},
          {"grant", index},
          {"t_s", grant.t},
          {"walk", grant.walk},
          {"world", grant.grant.version},
          {"through", grant.grant.through + 1},
          {"valid_until_s", OrNull(grant.grant.valid_until)}};
}

json EventMessage(const EpisodeEvent& event) {
  return {{"type", "event"},        {"t_s", event.t},     {"event", event.what},
          {"world", event.version}, {"walk", event.walk}, {"half_step", event.half_step + 1},
          {"text", event.text}};
}

json StateMessage(const RobotModel& robot, const SuperposedWalk& executed, double t, bool stopped,
                  bool held, int first) {
  return {
      {"type", "state"},    {"t_s", t},     {"half_step", first + executed.Locate(t).half_step + 1},
      {"stopped", stopped}, {"held", held}, {"row", RowJson(robot, executed, t)}};
}

json MotionMessage(const RobotModel& robot, const SuperposedWalk& executed, size_t walk,
                   double from, double until, double period) {
  json rows = json::array({RowJson(robot, executed, from)});
  const double end = std::min(until, executed.duration());
  for (long i = 1; from + static_cast<double>(i) * period <= end; ++i) {
    rows.push_back(RowJson(robot, executed, from + static_cast<double>(i) * period));
  }
  return {
      {"type", "motion"}, {"walk", walk}, {"from_s", from}, {"period_s", period}, {"rows", rows}};
}

json DrawMessage(const RobotModel& robot, const Scene& scene) {
  return {{"type", "draw"}, {"robot", RobotJson(robot)}, {"scene", ShapesJson(scene)}};
}

json EndMessage(const Episode& episode, const std::string& folder) {
  return {{"type", "end"},
          {"ending", Name(episode.ending)},
          {"message", episode.message},
          {"promise", PromiseSentence(episode.promise)},
          {"promise_status", Name(episode.promise.status())},
          {"folder", folder}};
}

json ErrorMessage(const std::string& text) { return {{"type", "error"}, {"text", text}}; }

std::string MessageText(const json& message) {
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace halfstep
