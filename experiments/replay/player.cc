#include "experiments/replay/player.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "wpg/elementary.h"
#include "wpg/geometry/rotation.h"
#include "wpg/geometry/support_polygon.h"
#include "wpg/nth.h"

namespace halfstep::replay {
namespace {

// A sole carries when this share of the weight is on it.
constexpr double kCarries = 0.05;

// A point of W as seen from a pose on the floor.
Eigen::Vector2d SeenFrom(const Pose2& X_WF, const Eigen::Vector2d& p_W) {
  const Eigen::Vector2d d = p_W - Eigen::Vector2d(X_WF.x, X_WF.y);
  return PlaneRotation(-X_WF.yaw) * d;
}

// Simulated less planned place of a sole on the floor.
Eigen::Vector3d DriftOfSole(const Eigen::Vector4d& planned, const Pose2& here) {
  return {here.x - planned[0], here.y - planned[1],
          std::remainder(here.yaw - planned[3], 2 * std::numbers::pi)};
}

}  // namespace

Pose2 OnFloor(const Eigen::Isometry3d& X_WB) {
  return {X_WB.translation().x(), X_WB.translation().y(), Atan2(X_WB(1, 0), X_WB(0, 0))};
}

Player::Player(const Simulation& robot, const ReferenceMotion& motion, const PlayOptions& options)
    : robot_(robot), options_(options) {
  const TrajectoryRow& first = motion.rows().front();
  if (options.control) control_.emplace(*options.control);
  robot_.Place(robot_.X_WFloor() * first.X_WB(), first.q);
  const long steps = std::lround(options.settle / robot_.timestep());
  for (long i = 1 - steps; i <= 0; ++i) {
    const double t = first.t + static_cast<double>(i) * robot_.timestep();
    robot_.Step(TargetsAt(t, motion), Eigen::Vector3d::Zero());
  }
}

Player::Creep Player::CreepOf(Side side, bool carries) {
  std::optional<Pose2>& anchor = Nth(anchors_, Index(side));
  const Pose2 here = OnFloor(robot_.X_WSole(side));
  if (!carries) anchor.reset();
  if (!carries) return {};
  if (!anchor) anchor = here;
  return {(here.position() - anchor->position()).norm(),
          std::abs(std::remainder(here.yaw - anchor->yaw, 2 * std::numbers::pi))};
}

double Player::EdgeOf(const Eigen::Vector2d& pressure,
                      const std::array<double, 2>& vertical) const {
  const double least = kCarries * robot_.weight();
  const Pose2 left = OnFloor(robot_.X_WSole(Side::kLeft));
  const Pose2 right = OnFloor(robot_.X_WSole(Side::kRight));
  const Eigen::Vector2d size = robot_.sole_size();
  if (vertical[0] > least && vertical[1] > least) {
    return SupportPolygon(left, right, size).Margin(pressure);
  }
  if (vertical[0] > least) return SupportPolygon(left, size).Margin(pressure);
  if (vertical[1] > least) return SupportPolygon(right, size).Margin(pressure);
  return std::numeric_limits<double>::quiet_NaN();
}

bool Player::HasDropped(const ReferenceMotion& motion) const {
  if (std::isinf(options_.fallen_drop)) return false;
  const Eigen::Vector3d here = robot_.X_WFloor().inverse() * robot_.X_WB().translation();
  return motion.RowAt(t_).waist[2] - here.z() > options_.fallen_drop;
}

double Player::DriftFrom(const ReferenceMotion& motion) const {
  const TrajectoryRow planned = motion.RowAt(t_);
  return (robot_.X_WB().translation().head<2>() - planned.waist.head<2>()).norm();
}

double Player::StrayFrom(const TrajectoryRow& planned, const Eigen::Vector3d& shift) const {
  double stray = (robot_.X_WB().translation() - planned.waist.head<3>() - shift).norm();
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Eigen::Vector4d& sole = Nth(planned.soles, Index(side));
    stray = std::max(stray, (robot_.X_WSole(side).translation() - sole.head<3>() - shift).norm());
  }
  return stray;
}

ReplayRow Player::Advance(const ReferenceMotion& motion, const std::optional<Push>& push) {
  const double dt = robot_.timestep();
  const double begin = static_cast<double>(row_) * options_.row_period;
  const long steps = std::lround(options_.row_period / dt);
  Eigen::Vector2d moment(0, 0), pressure(0, 0), horizontal(0, 0);
  ReplayRow row;
  for (long i = 0; i < steps; ++i) {
    // The targets of where the step ends.
    const double t = begin + static_cast<double>(i + 1) * dt;
    Eigen::Vector3d force(0, 0, 0);
    if (push && t > push->at && t <= push->at + push->duration + 1e-9) {
      force = push->impulse_W / push->duration;
    }
    // Contacts are those of where the step begins.
    robot_.MoveObstacles(t - dt);
    const FloorForces floor = robot_.Step(TargetsAt(t, motion), force);
    const std::vector<Touch> touches = robot_.touches();
    touches_.Note(t - dt, touches, motion.RestsAt(t - dt));
    for (const Touch& touch : touches) row.touch = std::max(row.touch, touch.force);
    moment += floor.moment;
    pressure += floor.pressure;
    horizontal += floor.horizontal;
    for (size_t side = 0; side < 2; ++side) row.vertical[side] += floor.vertical[side];
  }
  t_ = static_cast<double>(++row_) * options_.row_period;
  const TrajectoryRow planned = motion.RowAt(t_ - options_.row_period / 2);
  const Eigen::Isometry3d X_WB = robot_.X_WB();
  row.t = t_;
  row.tilt = Acos(std::clamp(X_WB(2, 2), -1.0, 1.0));
  row.waist = X_WB.translation();
  row.fallen = row.tilt > options_.fallen_tilt || HasDropped(motion);
  row.zmp_planned = planned.zmp;
  row.zmp_measured.setConstant(std::numeric_limits<double>::quiet_NaN());
  row.zmp_error = row.zmp_measured;
  const double total = row.vertical[0] + row.vertical[1];
  if (total > 0) {
    if (planned.zmp_z != 0.0) moment += planned.zmp_z * horizontal;
    row.zmp_measured = moment / total;
    const Side side = row.vertical[0] >= row.vertical[1] ? Side::kLeft : Side::kRight;
    const Eigen::Vector4d& sole = Nth(planned.soles, Index(side));
    row.zmp_error = SeenFrom(OnFloor(robot_.X_WSole(side)), row.zmp_measured) -
                    SeenFrom({sole[0], sole[1], sole[3]}, row.zmp_planned);
  }
  row.support_drift.setConstant(std::numeric_limits<double>::quiet_NaN());
  double most = 0.0;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    double& force = Nth(row.vertical, Index(side));
    force /= static_cast<double>(steps);
    const bool carries = Nth(planned.stands, Index(side)) && force > kCarries * robot_.weight();
    const Creep creep = CreepOf(side, carries);
    row.slip = std::max(row.slip, creep.slip);
    row.turn = std::max(row.turn, creep.turn);
    if (!carries || force <= most) continue;
    most = force;
    row.support = side;
    row.support_drift = DriftOfSole(Nth(planned.soles, Index(side)), OnFloor(robot_.X_WSole(side)));
  }
  row.edge = EdgeOf(pressure / total, row.vertical);
  const Eigen::Vector3d shift(row.support_drift[0], row.support_drift[1], 0.0);
  row.stray = StrayFrom(motion.RowAt(t_), shift);
  if (row.support) row.off = TrackingErrorOf(robot_, motion, t_, shift);
  return row;
}

}  // namespace halfstep::replay
