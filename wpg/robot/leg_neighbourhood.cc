#include "wpg/robot/leg_neighbourhood.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "wpg/check.h"
#include "wpg/nth.h"
#include "wpg/robot/paden_kahan.h"
#include "wpg/robot/placing_rounding.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// Of sums of terms that are ≥ 0, for their rounding.
constexpr double kSums = 1.0 + 0x1p-43;

Eigen::Index Pair(int l, int j) { return j * (j - 1) / 2 + l; }

// How the line of joint j moves when the whole of it is turned by joint l: [ξ_l, ξ_j].
Vector6d Bracket(const Vector6d& l, const Vector6d& j) {
  const Vector3d turn = l.head<3>(), axis = j.head<3>();
  Vector6d bracket;
  bracket << turn.cross(axis), turn.cross(j.tail<3>()) + Vector3d(l.tail<3>()).cross(axis);
  return bracket;
}

}  // namespace

// As PlaceLeg does, with what each point moves per unit of the share.
void LegNeighbourhood::Place(const Leg& leg, const Vector6d& q, double share, Matrix6d* J) {
  const Leg& met = leg.met.front();
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Vector3d t(0, 0, 0), t_rate(0, 0, 0);  // x ↦ R x + t, and dt/dshare
  Vector3d last = leg.hip_B, last_met = leg.hip_B, last_offset(0, 0, 0);
  double lever = 0.0, offsets = 0.0;
  PlacingRounding rounding;
  std::array<Vector3d, 6> moves;
  for (size_t j = 0; j < 6; ++j) {
    const Vector3d own = leg.AxisPoint(j), its = met.AxisPoint(j), offset = own - its;
    const Eigen::Index k = static_cast<Eigen::Index>(j);
    lever_[k] = lever += std::max((own - last).norm(), (its - last_met).norm());
    offset_[j] = offsets += (offset - last_offset).norm();
    last = own, last_met = its, last_offset = offset;
    const Vector3d at_zero = its + share * offset;
    const Vector3d axis = R * leg.joints[j].axis_B;
    const Vector3d point = R * at_zero + t, point_rate = R * offset + t_rate;
    J->col(k) << axis, axis.cross(leg.hip_B - point);
    moves[j] = -axis.cross(point_rate);
    const Turn turn = Turn::FromAngle(q[k]);
    for (int column = 0; column < 3; ++column) {
      R.col(column) = Rotate(axis, turn, Vector3d(R.col(column)));
    }
    rounding.Turned(q[k], SkewOf(R));
    t = point - R * at_zero;
    t_rate = point_rate - R * offset;
  }
  const Vector3d sole_met = met.X_BSole.translation();
  const Vector3d sole_offset = leg.X_BSole.translation() - sole_met;
  offset_[6] = offsets + (sole_offset - last_offset).norm();
  X_BSole_ = Eigen::Isometry3d::Identity();
  X_BSole_.linear() = R * leg.X_BSole.linear();
  X_BSole_.translation() = R * (sole_met + share * sole_offset) + t;
  // Sums of a dozen products as large as the leg or its offsets, beside the turned directions.
  const double size =
      leg.hip_B.norm() + lever + offset_[6] + (leg.X_BSole.translation() - last).norm();
  turn_off_ = rounding.turn() + 64.0 * kRoundoff;
  place_off_ = turn_off_ * size + 128.0 * kRoundoff * size;
  share_off_ = 16.0 * turn_off_ * offset_[6];
  by_share_ << Vector3d::Zero(), -(R * sole_offset + t_rate);
  for (size_t j = 0; j < 6; ++j) {
    share_change_.col(static_cast<Eigen::Index>(j)) << Vector3d::Zero(), moves[j];
  }
}

std::optional<LegNeighbourhood> LegNeighbourhood::Around(const Leg& leg, const Vector6d& q,
                                                         double share) {
  HALFSTEP_CHECK(!leg.closed_form(), "a leg with a closed form");
  LegNeighbourhood here;
  Matrix6d J;
  here.Place(leg, q, share, &J);
  const Eigen::PartialPivLU<Matrix6d> lu(J);
  const double length = here.lever_[5];
  if (!(std::abs(lu.determinant()) > 1e-7 * length * length * length)) return std::nullopt;
  here.inverse_ = lu.inverse();
  Eigen::Matrix<double, 6, kPairs> brackets;
  for (int j = 1; j < 6; ++j) {
    for (int l = 0; l < j; ++l) brackets.col(Pair(l, j)) = Bracket(J.col(l), J.col(j));
  }
  here.brackets_.noalias() = here.inverse_ * brackets;
  here.angular_ = here.inverse_.leftCols<3>().rowwise().norm();
  here.linear_ = here.inverse_.rightCols<3>().rowwise().norm();
  here.off_ = (here.inverse_ * J - Matrix6d::Identity()).cwiseAbs();
  here.off_.colwise() += here.AskedAnyWay(2.0 * here.turn_off_, 3.0 * here.place_off_);
  here.brackets_off_ = here.AskedAnyWay(4.0 * here.turn_off_, 16.0 * here.place_off_);
  here.by_share_ = here.inverse_ * Vector6d(here.by_share_);
  here.share_change_ = here.inverse_ * Matrix6d(here.share_change_);
  return here;
}

Vector6d LegNeighbourhood::Bend(const Vector6d& speeds) const {
  Vector6d bend = Vector6d::Zero();
  for (int j = 1; j < 6; ++j) {
    for (int l = 0; l < j; ++l) bend -= speeds[l] * speeds[j] * brackets_.col(Pair(l, j));
  }
  return bend;
}

// ξ_j turned by the joints before it: to first order the brackets; the second derivatives have an
// angular part of at most 1 and a linear part of at most the levers of the three joints in play.
// The share moves ξ_j's line by a vector that turns with the same joints.
Matrix6d LegNeighbourhood::Change(const Vector6d& radius, double share) const {
  Matrix6d change = off_ + share * share_change_.cwiseAbs();
  change.colwise() += share * ByShareRounding();
  double turn = 0.0, swing = 0.0;  // Σ_{l<j} of the radii, and times the lever
  for (int j = 1; j < 6; ++j) {
    turn += radius[j - 1];
    swing += radius[j - 1] * lever_[j - 1];
    const double half = 0.5 * turn * turn;
    const double line = share * 2.0 * turn * Nth(offset_, j);
    change.col(j) +=
        half * angular_ + (half * lever_[j] + turn * swing + line) * linear_ + turn * brackets_off_;
    for (int l = 0; l < j; ++l) change.col(j) += radius[l] * brackets_.col(Pair(l, j)).cwiseAbs();
  }
  return change;
}

Vector6d LegNeighbourhood::Bending(const Vector6d& speeds, const Vector6d& radius) const {
  Vector6d bending = Vector6d::Zero();
  double turn = 0.0, swing = 0.0;
  for (int j = 1; j < 6; ++j) {
    turn += radius[j - 1];
    swing += radius[j - 1] * lever_[j - 1];
    for (int l = 0; l < j; ++l) {
      const double lever = turn * (lever_[j] + lever_[l]) + swing;
      bending += speeds[l] * speeds[j] *
                 (brackets_.col(Pair(l, j)).cwiseAbs() + turn * angular_ + lever * linear_ +
                  brackets_off_);
    }
  }
  return bending;
}

Vector6d LegNeighbourhood::Asked(double yaw, double velocity) const {
  return yaw * inverse_.col(2).cwiseAbs() + velocity * linear_;
}

Vector6d LegNeighbourhood::AskedAnyWay(double turn, double velocity) const {
  return turn * angular_ + velocity * linear_;
}

// Going along the path, ways ℓ ≤ asked + Change·ℓ hold as far as they are within the radius; and
// they would have to pass what is implied before they pass that.
std::optional<Vector6d> LegNeighbourhood::Ways(const Vector6d& asked, double share) const {
  constexpr double kFar = 1.0;  // [rad]
  const Vector6d here = asked + share * (by_share_.cwiseAbs() + ByShareRounding());
  Vector6d radius = 1.1 * here + Vector6d::Constant(1e-12);
  for (int attempt = 0; attempt < 12; ++attempt) {
    Vector6d implied = here + Change(radius, share) * radius;
    double turn = 0.0, turned = 0.0;  // how much the offsets' sum can have turned
    for (size_t j = 0; j < 6; ++j) {
      turn += radius[static_cast<Eigen::Index>(j)];
      turned += turn * (offset_[j + 1] - offset_[j]);
    }
    implied = kSums * (implied + share * turned * linear_);
    if ((implied.array() < radius.array()).all()) return implied;
    if (!(implied.maxCoeff() < kFar)) return std::nullopt;
    radius = 1.1 * implied + Vector6d::Constant(1e-12);
  }
  return std::nullopt;
}

// The functional differs from J⁻¹ξ by what the sole has turned and moved.
Matrix6d LegNeighbourhood::PoseChange(const Vector6d& radius) const {
  const double turn = radius.sum(), moved = radius.dot(lever_) / (1.0 - turn);
  const Vector6d more = 0.5 * turn * angular_ + moved * linear_;
  return Change(radius).colwise() + more;
}

// Poses as matrices have differences: along the straight way between two postures that of poses is
// the mean of its derivatives, of which none is singular.
bool LegNeighbourhood::InjectiveWithin(const Vector6d& radius) const {
  return radius.sum() < 0.5 && Contraction::Of(PoseChange(radius)).has_value();
}

std::optional<Contraction> Contraction::Of(const Matrix6d& M) {
  Vector6d v = Vector6d::Ones();
  for (int k = 0; k < 8; ++k) v = Vector6d::Ones() + M * v;
  const double share = (M * v).cwiseQuotient(v).maxCoeff();
  if (!(share < 1.0 - 0x1p-20)) return std::nullopt;
  return Contraction{v, share};
}

// With u ≤ κv, κv/(1 − share) is an upper bound, but for rounding; every further round keeps that
// and lowers it.
Vector6d Contraction::Resolve(const Matrix6d& M, const Vector6d& u) const {
  Vector6d x = (1.0 + 0x1p-28) * u.cwiseQuotient(weights).maxCoeff() / (1.0 - share) * weights;
  for (int k = 0; k < 6; ++k) x = u + M * x;
  return x;
}

}  // namespace halfstep
