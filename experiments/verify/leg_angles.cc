#include "experiments/verify/leg_angles.h"

#include <Eigen/LU>
#include <cmath>

namespace halfstep::verify {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Of the amplitude of a cos q + b sin q: rounding may put a just reachable pose this far outside.
constexpr double kSlack = 1e-12;
// In so many parts do the axes move.
constexpr int kParts = 16;

// Newton's steps from angles near by: the first at most, each against the one before, and one after
// which the rest is rounding [rad].
constexpr double kNearAngles = 0.05, kShrinks = 0.25, kLast = 1e-8;
constexpr int kMostSteps = 8;

Matrix3d Turned(const Vector3d& axis, double q) {
  return Eigen::AngleAxisd(q, axis).toRotationMatrix();
}

// The q at which a cos q + b sin q = c; `side` +1: where that falls, −1: where it rises.
std::optional<double> Solve(double a, double b, double c, double side) {
  const double cosine = c / std::hypot(a, b);
  if (!(std::abs(cosine) <= 1 + kSlack)) return std::nullopt;
  const double sine = std::sqrt(std::max((1 - cosine) * (1 + cosine), 0.0));
  return std::remainder(std::atan2(b, a) + side * std::atan2(sine, cosine), 2 * M_PI);
}

// The q at which u · R(axis, q) v = c.
std::optional<double> Solve(const Vector3d& u, const Vector3d& axis, const Vector3d& v, double c,
                            double side) {
  const double along = u.dot(axis) * axis.dot(v);
  return Solve(u.dot(v) - along, u.dot(axis.cross(v)), c - along, side);
}

// The angle about `axis` from one vector to another, as seen along it.
double AngleFromTo(const Vector3d& axis, const Vector3d& from, const Vector3d& to) {
  return std::atan2(axis.dot(from.cross(to)), from.dot(to) - axis.dot(from) * axis.dot(to));
}

double SideOf(int choice) { return choice == 0 ? 1 : -1; }

std::optional<Vector6d> ClosedForm(const Leg& leg, const Isometry3d& X_BSole) {
  const auto axis = [&](size_t j) -> const Vector3d& { return leg.joints[j].axis_B; };
  const Isometry3d G = X_BSole * leg.X_BSole.inverse();
  // Knee: |e₃a − h| = |G a − h|.
  const Vector3d h = leg.hip_B - leg.joints[3].point_B, a = leg.ankle_B - leg.joints[3].point_B;
  const double distance2 = (G * leg.ankle_B - leg.hip_B).squaredNorm();
  const auto q3 = Solve(h, axis(3), a, (h.squaredNorm() + a.squaredNorm() - distance2) / 2,
                        SideOf(leg.branch.knee));
  if (!q3) return std::nullopt;
  const Matrix3d R3 = Turned(axis(3), *q3);
  // Ankle: the hip, seen from the foot about a, is e₅⁻¹e₄⁻¹p = s.
  const Vector3d p = R3.transpose() * h - a, s = G.inverse() * leg.hip_B - leg.ankle_B;
  const auto back4 = Solve(axis(5), axis(4), p, axis(5).dot(s), -SideOf(leg.branch.ankle));
  if (!back4) return std::nullopt;
  const Matrix3d R4 = Turned(axis(4), -*back4);
  const double q5 = AngleFromTo(axis(5), s, R4.transpose() * p);
  // Hip: R₀R₁R₂ = R is what remains.
  const Matrix3d R = G.linear() * (R3 * R4 * Turned(axis(5), q5)).transpose();
  const Vector3d v = R * axis(2);
  const auto q1 = Solve(axis(0), axis(1), axis(2), axis(0).dot(v), -SideOf(leg.branch.hip));
  if (!q1) return std::nullopt;
  const Matrix3d R1 = Turned(axis(1), *q1);
  const double q0 = AngleFromTo(axis(0), R1 * axis(2), v);
  const Matrix3d R2 = (Turned(axis(0), q0) * R1).transpose() * R;
  Vector6d q;
  q << q0, *q1, AngleFromTo(axis(2), axis(1), R2 * axis(1)), *q3, -*back4, q5;
  return q;
}

Vector6d NewtonStep(const LegPlace& at, const Isometry3d& X_BSole) {
  Matrix6d J;
  for (size_t j = 0; j < 6; ++j) {
    J.col(static_cast<Eigen::Index>(j)) << at.axes[j],
        at.axes[j].cross(at.X_BLink[6].translation() - at.points[j]);
  }
  return J.partialPivLu().solve(FromSoleTo(at, X_BSole));
}

// From the angles of the leg whose axes meet.
Vector6d Followed(const Leg& leg, Vector6d q, const Isometry3d& X_BSole) {
  Leg between = leg;
  for (int part = 1; part <= kParts; ++part) {
    const double share = static_cast<double>(part) / kParts;
    for (size_t j = 0; j < 6; ++j) {
      const Vector3d& met = leg.met.front().joints[j].point_B;
      between.joints[j].point_B = met + share * (leg.joints[j].point_B - met);
    }
    for (int k = 0; k < (part < kParts ? 2 : 6); ++k) {
      q += NewtonStep(PlaceLegAt(between, q), X_BSole);
    }
  }
  return q;
}

// From angles on the same branch that are about the ones sought; none where that cannot be told.
std::optional<Vector6d> FollowedFrom(const Leg& leg, Vector6d q, const Isometry3d& X_BSole) {
  double most = kNearAngles;
  for (int k = 0; k < kMostSteps; ++k) {
    const Vector6d step = NewtonStep(PlaceLegAt(leg, q), X_BSole);
    if (!(step.cwiseAbs().array() <= most).all()) return std::nullopt;
    q += step;
    const double size = step.cwiseAbs().maxCoeff();
    if (size <= kLast) return q;
    most = kShrinks * size;
  }
  return std::nullopt;
}

}  // namespace

LegPlace PlaceLegAt(const Leg& leg, const Vector6d& q) {
  LegPlace place;
  Isometry3d moved = Isometry3d::Identity();  // what the joints so far have made of B's points
  for (size_t j = 0; j < 6; ++j) {
    const LegJoint& joint = leg.joints[j];
    place.axes[j] = moved.linear() * joint.axis_B;
    place.points[j] = moved * joint.point_B;
    moved.linear() *= Turned(joint.axis_B, q[static_cast<Eigen::Index>(j)]);
    moved.translation() = place.points[j] - moved.linear() * joint.point_B;
    place.X_BLink[j] = moved * joint.X_BLink;
  }
  place.X_BLink[6] = moved * leg.X_BSole;
  return place;
}

Vector6d FromSoleTo(const LegPlace& place, const Isometry3d& X_BSole) {
  const Isometry3d& X_BF = place.X_BLink[6];
  const Eigen::AngleAxisd turn(X_BSole.linear() * X_BF.linear().transpose());
  Vector6d rest;
  rest << turn.angle() * turn.axis(), X_BSole.translation() - X_BF.translation();
  return rest;
}

std::optional<Vector6d> AnglesOf(const Leg& leg, const Isometry3d& X_BSole, const Vector6d* near) {
  if (leg.met.empty()) return ClosedForm(leg, X_BSole);
  if (near != nullptr) {
    if (const auto q = FollowedFrom(leg, *near, X_BSole)) return q;
  }
  const auto q = ClosedForm(leg.met.front(), X_BSole);
  if (!q) return std::nullopt;
  return Followed(leg, *q, X_BSole);
}

}  // namespace halfstep::verify
