#include <algorithm>
#include <array>

#include "experiments/plot/style.h"
#include "experiments/plot/subjects.h"

namespace halfstep::plot {
namespace {

using Eigen::Vector2d;

constexpr size_t kKnee = 3;
const std::array<Side, 2> kSides = {Side::kLeft, Side::kRight};

std::vector<std::string> Parts(const std::string& name) {
  std::vector<std::string> parts(1);
  for (const char c : name) {
    if (c == '_') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

// What the names of a joint of both legs have in common: "JOINT3" of LLEG_JOINT3 and RLEG_JOINT3.
std::string CommonName(const std::string& left, const std::string& right) {
  const std::vector<std::string> a = Parts(left), b = Parts(right);
  std::string common;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (a[i] == b[i]) common += (common.empty() ? "" : " ") + a[i];
  }
  return common.empty() ? left + ", " + right : common;
}

// Differences of neighbouring rows.
std::vector<Vector2d> Speeds(const std::vector<Vector2d>& angles) {
  std::vector<Vector2d> speeds;
  for (size_t i = 0; i < angles.size(); ++i) {
    const Vector2d &before = angles[i == 0 ? 0 : i - 1],
                   &after = angles[std::min(i + 1, angles.size() - 1)];
    speeds.emplace_back(angles[i].x(), (after.y() - before.y()) / (after.x() - before.x()));
  }
  return speeds;
}

void AddLimits(double low, double high, Side side, double end, Panel* panel, Extent* extent) {
  for (const double limit : {low, high}) {
    panel->lines.push_back({.name = "limit",
                            .points = {{0.0, limit}, {end, limit}},
                            .stroke = {.color = style::Lighter(style::LineOf(side).color, 0.2),
                                       .width = 0.6,
                                       .dash = {0.8, side == Side::kLeft ? 1.6 : 2.4}}});
    extent->Add(limit);
  }
}

// Angle and speed of one joint of both legs.
Row JointRow(const PlottedRun& run, const PlottedWalk& walk, size_t joint) {
  Panel angle, speed;
  Extent angles, speeds;
  for (const Side side : kSides) {
    const LegJoint& one = run.place.robot.legs[static_cast<size_t>(Index(side))].joints[joint];
    Line line{.name = walk.method + "/q_" + one.name + "_rad",
              .points = walk.OverTime("q_" + one.name + "_rad"),
              .stroke = style::LineOf(side)};
    Line rate{.name = walk.method + "/speed_" + one.name + "_rad_s",
              .points = Speeds(line.points),
              .stroke = style::LineOf(side)};
    // Where the legs differ most.
    if (joint == kKnee) line.label = std::string(halfstep::Name(side));
    angles.Add(line.points, 1);
    speeds.Add(rate.points, 1);
    AddLimits(one.lower, one.upper, side, run.duration(), &angle, &angles);
    const double most = run.joint_speed_scale * one.max_speed;
    AddLimits(-most, most, side, run.duration(), &speed, &speeds);
    angle.lines.push_back(std::move(line));
    speed.lines.push_back(std::move(rate));
  }
  angle.note = CommonName(run.place.robot.legs[0].joints[joint].name,
                          run.place.robot.legs[1].joints[joint].name);
  for (Panel* panel : {&angle, &speed}) {
    panel->x = {.label = "time [s]", .low = 0.0, .high = run.duration()};
    panel->y = (panel == &angle ? angles : speeds).WithMargin("");
    panel->height = 40.0;
    // Room for the joint's name.
    panel->y.high += 0.3 * (panel->y.high - panel->y.low);
    panel->numbers_below = joint == 5;
  }
  if (joint == 0) {
    const std::string whose = run.compares() ? walk.method + ": " : "";
    angle.title = whose + "angle [rad]";
    speed.title = "speed [rad/s]";
  }
  return {std::move(angle), std::move(speed)};
}

}  // namespace

std::vector<Row> JointsRows(const PlottedRun& run) {
  std::vector<Row> rows;
  for (const PlottedWalk& walk : run.walks) {
    for (size_t joint = 0; joint < 6; ++joint) rows.push_back(JointRow(run, walk, joint));
  }
  return rows;
}

}  // namespace halfstep::plot
