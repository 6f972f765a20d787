#include "experiments/server/client_message.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "experiments/server/message_fields.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

constexpr double kLongestMotion = 10.0;  // [s]
constexpr double kOldest = 1e6;          // [s]
constexpr double kMostTurn = 2.0 * std::numbers::pi;
constexpr double kMostCommands = 1e12;
constexpr double kMostAngle = 10.0;   // [rad]
constexpr double kMostSpeed = 100.0;  // [rad/s]
// Of commands, as a script's keys allow.
constexpr double kFastestCommand = 2.0;    // [m/s], [rad/s]
constexpr double kSlowestCommand = 0.001;  // along a path [m/s]
constexpr double kMostFootYaw = 36000.0;   // [deg]
constexpr int kMostPoints = 1000, kMostFootsteps = 100;

Eigen::Vector3d ReadPlace(MessageFields& fields) {
  return fields.Numbers("xyz_m", 3, -kFarthestMessage, kFarthestMessage);
}

double ReadTurn(MessageFields& fields) {
  return fields.Number("turn_rad", -kMostTurn, kMostTurn, 0.0);
}

Eigen::Vector2d ReadPoint(MessageFields& fields) {
  const double x = fields.Number("x_m", -kFarthestMessage, kFarthestMessage);
  const double y = fields.Number("y_m", -kFarthestMessage, kFarthestMessage);
  return {x, y};
}

size_t ObstacleNamed(MessageFields& fields, const std::string& key, const Scene& scene) {
  const std::string name = fields.Text(key);
  const auto found = std::ranges::find(scene.obstacles, name, &Obstacle::name);
  if (found == scene.obstacles.end()) {
    fields.Fail(key, Quote(name) + " is not in the scene (valid: the name of an obstacle)");
  }
  return static_cast<size_t>(found - scene.obstacles.begin());
}

Eigen::Matrix3d Orientation(MessageFields& fields) {
  const Eigen::Vector4d q = fields.Numbers("quaternion_wxyz", 4, -1.001, 1.001);
  if (!(std::abs(q.norm() - 1.0) <= 1e-3)) {
    fields.Fail("quaternion_wxyz",
                Formatted("has the length %.6g (valid: 1, up to 0.001)", q.norm()));
  }
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
}

Subscribe ReadSubscribe(MessageFields& fields, double control_period) {
  Subscribe subscribe{.state_period = fields.Number("state_period_s", 0.0, 3600.0),
                      .motion = fields.Number("motion_s", 0.0, kLongestMotion)};
  if (subscribe.state_period > 0.0 && subscribe.state_period < control_period) {
    fields.Fail("state_period_s", Formatted("is shorter than the control period (valid: 0, or "
                                            "from %g s)",
                                            control_period));
  }
  return subscribe;
}

MeasuredFrame ReadMeasured(MessageFields& fields, const Scene& scene) {
  MeasuredFrame frame;
  frame.age = fields.Number("age_s", 0.0, kOldest);
  for (MessageFields& one : fields.Objects("obstacles")) {
    MeasuredFrame::Seen seen{.obstacle = ObstacleNamed(one, "name", scene),
                             .X_WO = Eigen::Isometry3d::Identity()};
    seen.X_WO = scene.obstacles[seen.obstacle].X_WO;
    seen.X_WO.translation() = ReadPlace(one);
    if (one.Has("quaternion_wxyz")) seen.X_WO.linear() = Orientation(one);
    one.RefuseOthers();
    if (std::ranges::find(frame.seen, seen.obstacle, &MeasuredFrame::Seen::obstacle) !=
        frame.seen.end()) {
      one.Fail("name", "stands there twice (valid: each obstacle once)");
    }
    frame.seen.push_back(seen);
  }
  std::ranges::sort(frame.seen, {}, &MeasuredFrame::Seen::obstacle);
  if (fields.Has("goal")) {
    MessageFields goal = fields.Object("goal");
    frame.goal = ReadPoint(goal);
    goal.RefuseOthers();
  }
  if (fields.Has("areas")) {
    frame.areas.emplace();
    for (const int area : fields.Indices("areas", static_cast<int>(scene.no_step.size()))) {
      frame.areas->push_back(static_cast<size_t>(area - 1));
    }
  }
  return frame;
}

std::array<Vector6d, 2> BothLegs(MessageFields& fields, const std::string& key, double most) {
  const Eigen::MatrixXd rows = fields.Rows(key, 2, 6, -most, most);
  return {Vector6d(rows.row(0).transpose()), Vector6d(rows.row(1).transpose())};
}

Commanded ReadCommand(MessageFields& fields) {
  const double number = fields.Number("n", 1.0, kMostCommands);
  if (number != std::floor(number)) fields.Fail("n", "is no whole number (valid: from 1)");
  return {.number = static_cast<long>(number),
          .q = BothLegs(fields, "q_rad", kMostAngle),
          .speeds = BothLegs(fields, "speeds_rad_s", kMostSpeed)};
}

Command ReadWalk(MessageFields& fields) {
  Command command;
  command.event.what = "walk";
  for (const char* key : {"vx_m_s", "vy_m_s", "yaw_rad_s"}) {
    command.event.velocity.push_back(fields.Number(key, -kFastestCommand, kFastestCommand));
  }
  return command;
}

Command ReadFollow(MessageFields& fields) {
  Command command;
  command.event.what = "follow";
  const Eigen::MatrixXd rows =
      fields.RowsUpTo("path_m", 2, kMostPoints, 2, -kFarthestMessage, kFarthestMessage);
  command.event.path = rows.transpose();
  if (!IsPath(command.event.path)) {
    fields.Fail("path_m", "has a point twice in a row (valid: points 1 mm apart and more)");
  }
  command.event.speed = fields.Number("speed_m_s", kSlowestCommand, kFastestCommand);
  return command;
}

Command ReadFootsteps(MessageFields& fields) {
  Command command;
  command.event.what = "footsteps";
  for (MessageFields& one : fields.Objects("footsteps")) {
    CommandedFootstep footstep;
    const std::string foot = one.Text("foot");
    if (foot != "left" && foot != "right") {
      one.Fail("foot", Quote(foot) + " (valid: left, right)");
    }
    footstep.side = foot == "left" ? Side::kLeft : Side::kRight;
    const Eigen::Vector2d p = ReadPoint(one);
    const double yaw = one.Number("yaw_deg", -kMostFootYaw, kMostFootYaw, 0.0);
    footstep.X_WF = {p.x(), p.y(), yaw * std::numbers::pi / 180.0};
    one.RefuseOthers();
    command.event.footsteps.push_back(footstep);
  }
  const std::ptrdiff_t count = std::ssize(command.event.footsteps);
  if (count < 1 || count > kMostFootsteps) {
    fields.Fail("footsteps", Formatted("%td of them (valid: from 1 to %d)", count, kMostFootsteps));
  }
  return command;
}

Carry ReadCarry(MessageFields& fields, const Scene& scene) {
  return {.obstacle = ObstacleNamed(fields, "obstacle", scene),
          .to = ReadPlace(fields),
          .turn = ReadTurn(fields)};
}

}  // namespace

ClientMessageReader::ClientMessageReader(const Scene& scene, const LiveOptions& options,
                                         ClientPart part)
    : scene_(scene),
      part_(part),
      client_measures_(options.sensing.source == "client"),
      commands_(part == ClientPart::kWorld && options.policy == "replan"),
      control_period_(options.period) {}

ClientMessage ClientMessageReader::Read(std::string_view text) const {
  using Reader = std::function<ClientMessage(MessageFields&)>;
  const auto edit = [](auto value) -> ClientMessage { return Edit(value); };
  std::map<std::string, Reader> readers = {
      {"subscribe", [&](MessageFields& f) { return ReadSubscribe(f, control_period_); }},
      {"draw", [](MessageFields&) { return Draw{}; }},
      {"volumes", [](MessageFields&) { return TellVolumes{}; }},
      {"hold", [](MessageFields&) { return Hold{true}; }},
      {"release", [](MessageFields&) { return Hold{false}; }},
      {"end", [](MessageFields&) { return End{}; }}};
  if (part_ == ClientPart::kControl) {
    readers["control"] = [](MessageFields&) { return Controls{}; };
    readers["command"] = [](MessageFields& f) { return ReadCommand(f); };
  } else if (client_measures_) {
    readers["measured"] = [&](MessageFields& f) { return ReadMeasured(f, scene_); };
  } else {
    readers["carry"] = [&](MessageFields& f) { return edit(ReadCarry(f, scene_)); };
    readers["goal"] = [&](MessageFields& f) { return edit(MoveGoal{ReadPoint(f)}); };
    readers["add"] = [&](MessageFields& f) { return edit(AddBox{ReadPlace(f), ReadTurn(f)}); };
    readers["remove"] = [&](MessageFields& f) {
      return edit(Remove{ObstacleNamed(f, "obstacle", scene_)});
    };
  }
  if (part_ == ClientPart::kWorld) readers["again"] = [](MessageFields&) { return Again{}; };
  if (commands_) {
    readers["walk"] = [&](MessageFields& f) { return edit(ReadWalk(f)); };
    readers["follow"] = [&](MessageFields& f) { return edit(ReadFollow(f)); };
    readers["footsteps"] = [&](MessageFields& f) { return edit(ReadFootsteps(f)); };
  }
  const nlohmann::json object = ParseMessage(text);
  const std::string type = MessageFields(object, "").Text("type");
  const auto reader = readers.find(type);
  if (reader == readers.end()) {
    std::string valid;
    for (const auto& [name, unused] : readers) valid += (valid.empty() ? "" : ", ") + name;
    const std::string where =
        part_ == ClientPart::kControl
            ? "a client controls a simulated robot"
            : std::string("live.sensing.source is ") + (client_measures_ ? "client" : "stand_in");
    throw InputError({"type: " + Quote(type) + " is not taken here, where " + where +
                      " (valid: " + valid + ")"});
  }
  MessageFields fields(object, type);
  fields.Text("type");
  ClientMessage message = reader->second(fields);
  fields.RefuseOthers();
  return message;
}

}  // namespace halfstep
