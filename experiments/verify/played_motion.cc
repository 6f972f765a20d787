#include "experiments/verify/played_motion.h"

#include <algorithm>
#include <cmath>

#include "experiments/verify/csv_text.h"
#include "experiments/verify/leg_angles.h"
#include "experiments/verify/robot_numbers.h"
#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep::verify {
namespace {

PlayedRow RowOf(const CsvText& csv, size_t i, size_t num_margins) {
  PlayedRow row;
  row.t = csv.Number(i, 0);
  row.half_step = csv.Positive(i, 1);
  const std::string& support = csv.Cell(i, 2);
  if (support != "left" && support != "right" && support != "both") {
    csv.Refuse(i, 2, "is no support (valid: left, right, both)");
  }
  row.support = support == "left"    ? Support::kLeft
                : support == "right" ? Support::kRight
                                     : Support::kBoth;
  size_t column = 3;
  const auto read = [&](auto& vector) {
    for (double& value : vector) value = csv.Number(i, column++);
  };
  read(row.com);
  read(row.com_velocity);
  read(row.com_acceleration);
  read(row.zmp);
  read(row.waist);
  for (auto& sole : row.soles) read(sole);
  for (auto& q : row.q) read(q);
  for (size_t k = 0; k < num_margins; ++k) row.margins[k] = csv.Number(i, column++);
  return row;
}

}  // namespace

bool PlayedRow::AllFinite() const {
  return std::isfinite(t) && com.allFinite() && com_velocity.allFinite() &&
         com_acceleration.allFinite() && zmp.allFinite() && waist.allFinite() &&
         soles[0].allFinite() && soles[1].allFinite() && q[0].allFinite() && q[1].allFinite();
}

size_t NumMarginColumns(const RobotModel& robot) {
  return LimitsAccelerations(robot) ? kNumMarginColumns : kNumMarginColumns - 1;
}

std::vector<std::string> TrajectoryHeader(const RobotModel& robot) {
  std::vector<std::string> header = {"t_s",         "half_step",   "support",    "com_x_m",
                                     "com_y_m",     "com_z_m",     "com_vx_m_s", "com_vy_m_s",
                                     "com_ax_m_s2", "com_ay_m_s2", "zmp_x_m",    "zmp_y_m",
                                     "waist_x_m",   "waist_y_m",   "waist_z_m",  "waist_yaw_rad"};
  for (const char* foot : {"left_foot", "right_foot"}) {
    for (const char* of : {"_x_m", "_y_m", "_z_m", "_yaw_rad"}) {
      header.push_back(std::string(foot) + of);
    }
  }
  for (const Leg& leg : robot.legs) {
    for (const LegJoint& joint : leg.joints) header.push_back("q_" + joint.name + "_rad");
  }
  header.insert(header.end(), kMarginColumns.begin(),
                kMarginColumns.begin() + static_cast<std::ptrdiff_t>(NumMarginColumns(robot)));
  return header;
}

std::vector<PlayedRow> ReadTrajectory(const std::string& path, const std::string& text,
                                      const RobotModel& robot) {
  std::vector<PlayedRow> rows;
  // So that it does not grow to twice of what it needs.
  rows.reserve(static_cast<size_t>(std::ranges::count(text, '\n')));
  CsvText::InParts(path, text, TrajectoryHeader(robot), [&](const CsvText& csv) {
    for (size_t i = 0; i < csv.size(); ++i) rows.push_back(RowOf(csv, i, NumMarginColumns(robot)));
  });
  return rows;
}

PlayedMotion::PlayedMotion(const RobotModel& robot, const std::vector<PlayedRow>& rows)
    : robot_(robot), rows_(rows) {
  HALFSTEP_CHECK(rows.size() >= 2, rows.size() << " rows");
}

std::pair<size_t, double> PlayedMotion::Locate(double t) const {
  const auto after = std::upper_bound(rows_.begin(), rows_.end(), t,
                                      [](double at, const PlayedRow& row) { return at < row.t; });
  const auto i = std::clamp<std::ptrdiff_t>(after - rows_.begin() - 1, 0, std::ssize(rows_) - 2);
  const PlayedRow &a = Nth(rows_, i), &b = Nth(rows_, i + 1);
  return {static_cast<size_t>(i), std::clamp((t - a.t) / (b.t - a.t), 0.0, 1.0)};
}

PlayedRow PlayedMotion::At(double t) const {
  const auto [i, s] = Locate(t);
  const PlayedRow &a = rows_[i], &b = rows_[i + 1];
  PlayedRow row = a;
  const auto mix = [s = s](auto& of, const auto& towards) { of += s * (towards - of); };
  row.t = t;
  mix(row.com, b.com);
  mix(row.com_velocity, b.com_velocity);
  mix(row.com_acceleration, b.com_acceleration);
  mix(row.zmp, b.zmp);
  mix(row.waist, b.waist);
  for (size_t side = 0; side < 2; ++side) {
    mix(row.soles[side], b.soles[side]);
    mix(row.q[side], b.q[side]);
  }
  return row;
}

Placement PlaceRobot(const RobotModel& robot, const PlayedRow& row) {
  const Eigen::Vector4d& w = row.waist;
  return {
      ToIsometry({w[0], w[1], w[3]}, w[2]),
      {PlaceLegAt(robot.legs[0], row.q[0]).X_BLink, PlaceLegAt(robot.legs[1], row.q[1]).X_BLink}};
}

double FarthestFrom(const ConvexBody& body, const Eigen::Vector3d& point) {
  double farthest = 0;
  for (Eigen::Index i = 0; i < body.vertices.cols(); ++i) {
    const Eigen::Vector3d v = body.vertices.col(i) - point;
    farthest = std::max(farthest, std::hypot(v.head<2>().norm() + body.disc_radius, v.z()));
  }
  return farthest + body.ball_radius;
}

// Any point of a joint's axis serves; the one nearest to the hip keeps the sums small, for the
// three hip axes meet there or pass near.
std::array<double, 6> PlayedMotion::Radii(const RobotBody& body) const {
  const Leg& leg = Nth(robot_.legs, body.leg);
  std::array<Eigen::Vector3d, 6> on_axis;  // at the zero posture, where links keep their distances
  for (size_t j = 0; j < 6; ++j) {
    const LegJoint& joint = leg.joints[j];
    const Eigen::Vector3d& near = j < 3 ? leg.hip_B : j == 3 ? joint.point_B : leg.ankle_B;
    on_axis[j] = joint.point_B + joint.axis_B * joint.axis_B.dot(near - joint.point_B);
  }
  std::array<double, 6> radii{};
  const size_t link = static_cast<size_t>(body.link);
  const Eigen::Isometry3d X_LinkB = leg.joints[link].X_BLink.inverse();
  radii[link] = FarthestFrom(body.shape, X_LinkB * on_axis[link]);
  for (size_t j = link; j-- > 0;) radii[j] = radii[j + 1] + (on_axis[j + 1] - on_axis[j]).norm();
  return radii;
}

std::vector<double> PlayedMotion::PathInWaist(const RobotBody& body) const {
  std::vector<double> path(rows_.size(), 0.0);
  if (body.leg < 0) return path;
  const std::array<double, 6> radii = Radii(body);
  for (size_t i = 1; i < rows_.size(); ++i) {
    const Vector6d turned = (Nth(rows_[i].q, body.leg) - Nth(rows_[i - 1].q, body.leg)).cwiseAbs();
    path[i] = path[i - 1] + turned.dot(Vector6d(radii.data()));
  }
  return path;
}

double PlayedMotion::Sag(const RobotBody& body, size_t i) const {
  if (body.leg < 0) return 0;
  const std::array<double, 6> radii = Radii(body);
  const Vector6d turned = (Nth(rows_[i + 1].q, body.leg) - Nth(rows_[i].q, body.leg)).cwiseAbs();
  double second = 0;
  for (size_t j = 0; j < 6; ++j) {
    for (size_t k = 0; k < 6; ++k) {
      second += turned[static_cast<Eigen::Index>(j)] * turned[static_cast<Eigen::Index>(k)] *
                radii[std::max(j, k)];
    }
  }
  return second / 8;
}

std::vector<double> PlayedMotion::PathInWorld(const RobotBody& body) const {
  std::vector<double> path = PathInWaist(body);
  double lever = 0;  // of the body's points about the waist's vertical axis, at most
  if (body.leg < 0) {
    for (Eigen::Index i = 0; i < body.shape.vertices.cols(); ++i) {
      lever = std::max(lever, body.shape.vertices.col(i).head<2>().norm());
    }
    lever += body.shape.disc_radius + body.shape.ball_radius;
  } else {
    const LegJoint& first = Nth(robot_.legs, body.leg).joints[0];
    const Eigen::Vector3d hip =
        first.point_B +
        first.axis_B * first.axis_B.dot(Nth(robot_.legs, body.leg).hip_B - first.point_B);
    lever = hip.head<2>().norm() + Radii(body)[0];
  }
  double waist = 0;
  for (size_t i = 1; i < rows_.size(); ++i) {
    const Eigen::Vector4d moved = rows_[i].waist - rows_[i - 1].waist;
    waist += moved.head<3>().norm() + std::abs(moved[3]) * lever;
    path[i] += waist;
  }
  return path;
}

}  // namespace halfstep::verify
