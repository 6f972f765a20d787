#include "tests/oracle/tube_motions.h"

#include <algorithm>
#include <cmath>

namespace halfstep::oracle {
namespace {

double TurnOf(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d twice(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  return std::atan2(0.5 * twice.norm(), 0.5 * (R.trace() - 1));
}

bool IsNear(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double shift, double turn) {
  return (a.translation() - b.translation()).norm() <= shift + 1e-12 &&
         TurnOf(a.linear() * b.linear().transpose()) <= turn + 1e-12;
}

Eigen::Isometry3d Moved(Eigen::Isometry3d X, const Eigen::Vector3d& shift,
                        const Eigen::Vector3d& turn) {
  X.translation() += shift;
  if (const double angle = turn.norm(); angle > 0) {
    X.linear() = (Eigen::AngleAxisd(angle, turn / angle) * X.linear()).eval();
  }
  return X;
}

}  // namespace

double TubeMotions::Radius(const Way& way, int component) const {
  const bool waist = way.by_places ? component < 6 : way.base < 0;
  const int ball = component / 3;
  if (ball >= Balls(way)) return tube_.joint;
  if (ball % 2 == 0) return waist ? tube_.waist : tube_.foot;
  return waist ? tube_.waist_turn : tube_.foot_turn;
}

TubeMotions::Way TubeMotions::DrawWay() {
  Way way{.by_places = draw_->Chance(0.5), .base = draw_->Below(3) - 1};
  for (int i = 0; i < 18; ++i) {
    const double part = draw_->Uniform(-1, 1);
    if (i < 3 * Balls(way)) {
      if (i % 3 != 0) continue;
      const Eigen::Vector3d v = draw_->Vector(-1, 1);
      const double length = draw_->Chance(0.5) ? 1 : std::abs(part);
      way.error.segment<3>(i) = Radius(way, i) * length * v.normalized();
    } else {
      const double end = part < 0 ? -1 : 1;
      way.error[i] = Radius(way, i) * (draw_->Chance(0.5) ? end : part);
    }
  }
  return way;
}

std::optional<TubePosture> TubeMotions::Along(const Way& way, double part) const {
  TubePosture moved = plan_;
  const auto shifted = [&](const Eigen::Isometry3d& X, int at) {
    return Moved(X, part * way.error.segment<3>(at), part * way.error.segment<3>(at + 3));
  };
  if (way.by_places) {
    moved.X_WB = shifted(plan_.X_WB, 0);
    for (int leg = 0; leg < 2; ++leg) {
      const auto i = static_cast<size_t>(leg);
      const Eigen::Isometry3d X_BSole =
          moved.X_WB.inverse() * shifted(plan_.X_WSole(i), 6 + 6 * leg);
      if (!robot_.SolveLeg(leg, X_BSole, &moved.q[i])) return std::nullopt;
      moved.X_BLink[i] = robot_.PlaceLeg(leg, moved.q[i]);
    }
    return moved;
  }
  for (int leg = 0; leg < 2; ++leg) {
    const auto i = static_cast<size_t>(leg);
    moved.q[i] += part * way.error.segment<6>(6 + 6 * leg);
    moved.X_BLink[i] = robot_.PlaceLeg(leg, moved.q[i]);
  }
  if (way.base < 0) {
    moved.X_WB = shifted(plan_.X_WB, 0);
  } else {
    const auto i = static_cast<size_t>(way.base);
    moved.X_WB = shifted(plan_.X_WSole(i), 0) * moved.X_BLink[i][6].inverse();
  }
  return moved;
}

bool TubeMotions::IsWithin(const TubePosture& moved) const {
  bool within = IsNear(moved.X_WB, plan_.X_WB, tube_.waist, tube_.waist_turn);
  for (size_t leg = 0; leg < 2; ++leg) {
    within = within &&
             IsNear(moved.X_WSole(leg), plan_.X_WSole(leg), tube_.foot, tube_.foot_turn) &&
             (moved.q[leg] - plan_.q[leg]).cwiseAbs().maxCoeff() <= tube_.joint + 1e-12;
  }
  return within;
}

TubePosture TubeMotions::Furthest(const Way& way) const {
  TubePosture furthest = plan_;
  double inside = 0, outside = 1;
  for (double part = 1; outside - inside > 1e-3; part = 0.5 * (inside + outside)) {
    const std::optional<TubePosture> moved = Along(way, part);
    const bool within = moved && IsWithin(*moved);
    (within ? inside : outside) = part;
    if (within) furthest = *moved;
  }
  return furthest;
}

TubePosture TubeMotions::Lowering(const std::function<double(const TubePosture&)>& value) {
  Way way{.by_places = draw_->Chance(0.5), .base = draw_->Below(3) - 1};
  Eigen::Matrix<double, 18, 1> slope;
  const double before = value(plan_);
  for (int i = 0; i < 18; ++i) {
    constexpr double kStep = 1e-5;
    way.error.setZero();
    way.error[i] = kStep;
    const std::optional<TubePosture> ahead = Along(way, 1);
    slope[i] = ahead ? (value(*ahead) - before) / kStep : 0;
    if (!std::isfinite(slope[i])) slope[i] = 0;
  }
  way.error.setZero();
  for (int i = 0; i < 18; ++i) {
    const bool ball = i < 3 * Balls(way);
    if ((ball && i % 3 != 0) || draw_->Chance(0.25)) continue;
    const int size = ball ? 3 : 1;
    const double steep = slope.segment(i, size).norm();
    if (steep > 1e-9) {
      way.error.segment(i, size) = -Radius(way, i) / steep * slope.segment(i, size);
    }
  }
  return Furthest(way);
}

}  // namespace halfstep::oracle
