#include "wpg/motion/torque_drift.h"

#include <algorithm>
#include <cmath>

#include "wpg/nth.h"
#include "wpg/rounded.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// How much the moment of weighted masses about a point that moves drifts: by direction, to first
// order in time, what their weights do to it; by norms all else.
struct MomentDrift {
  Vector3d rate{0, 0, 0};  // of the weights' moment at m [N m/s]
  double rest = 0.0;       // [N m]

  // sup ‖moment(t) − moment(m)‖ in an interval of half width h.
  double Norm(double h) const { return h * rate.norm() + rest; }
};

Vector3d MomentAbout(const Vector3d& point, const Vector6d& wrench) {
  return wrench.head<3>() - point.cross(wrench.tail<3>());
}

}  // namespace

TorqueDrift::TorqueDrift(const IntervalMotion& motion, const RobotDrift& drift,
                         const RobotDynamics& at_m, const FootLoads& loads, double zmp_moved,
                         double gravity, double soles_off)
    : motion_(motion),
      drift_(drift),
      at_m_(at_m),
      loads_(loads),
      share_drift_(loads.both() ? loads.ShareDrift(zmp_moved + 2.0 * soles_off) + 8.0 * kRoundoff
                                : 0.0),
      soles_off_(soles_off),
      gravity_(gravity) {}

// The axis is fixed in both bodies that the joint joins: what drifts less counts.
TorqueDrift::Axis TorqueDrift::AxisOf(Side side, size_t joint) const {
  const size_t s = static_cast<size_t>(Index(side));
  const Posture& posture = motion_.posture;
  const LegDrift& leg = drift_.legs[s];
  const Vector3d point = posture.X_WB * posture.frames[s].point_B[joint];
  const BodyRounding& off = drift_.rounding.legs[s][joint];
  const auto at = [&](const RigidDrift& body, const Vector3d& its_point) {
    return body.At((point - its_point).norm() + 2.0 * off.place);
  };
  const RigidDrift above = joint == 0 ? at(drift_.waist, posture.X_WB.translation())
                                      : at(leg.links[joint - 1], leg.points[joint - 1]);
  const RigidDrift below = at(leg.links[joint], leg.points[joint]);
  const RobotDynamics::Body& link = at_m_.leg(side)[joint];
  Axis axis;
  axis.point = point - at_m_.O();
  axis.direction = link.screw.head<3>();
  const Vector3d turn = link.velocity.head<3>();
  axis.velocity = link.velocity.tail<3>() + turn.cross(axis.point);
  const Vector3d acceleration = link.acceleration.tail<3>() +
                                link.acceleration.head<3>().cross(axis.point) +
                                turn.cross(axis.velocity) - gravity_ * Vector3d::UnitZ();
  axis.off = off.Of(link, axis.point);
  axis.p = std::min(above.p, below.p) + axis.off.place;
  axis.turned = std::min(std::min(above.turned, below.turned) + off.turn, 2.0);
  axis.most_acceleration =
      acceleration.norm() + axis.off.acceleration + std::min(above.p2, below.p2);
  return axis;
}

double TorqueDrift::OfJoint(Side side, size_t joint) const {
  const double h = motion_.half_width, share = loads_.share(side);
  const Axis axis = AxisOf(side, joint);
  MomentDrift weighted, all;
  const auto add = [&](const MassDrift& body, double weight) {
    const Vector3d rate =
        body.mass * gravity_ * (body.velocity - axis.velocity).cross(Vector3d::UnitZ());
    const double weight_off = body.off.place + axis.off.place +
                              h * (body.off.speed + axis.off.speed) +
                              0.5 * h * h * (body.MostAcceleration() + axis.most_acceleration);
    const double rest =
        body.mass * (gravity_ * weight_off + (body.com - axis.point).norm() * body.p2 +
                     (body.p + axis.p) * body.MostAcceleration()) +
        body.moment;
    weighted.rate += weight * rate;
    weighted.rest += std::abs(weight) * rest;
    all.rate += rate;
    all.rest += rest;
  };
  add(drift_.waist_mass, -share);
  Vector6d hung = Vector6d::Zero();
  for (const Side other : {Side::kLeft, Side::kRight}) {
    for (size_t j = 0; j < 6; ++j) {
      const bool hangs = other == side && j >= joint;
      add(Nth(drift_.link_masses, Index(other))[j], (hangs ? 1.0 : 0.0) - share);
      if (hangs) hung += at_m_.leg(other)[j].force;
    }
  }
  // The moment at m, its part across the axis, and the axis' turning.
  const Vector6d on_foot = loads_.On(side, at_m_.contact());
  const Vector3d moment = MomentAbout(axis.point, hung - on_foot);
  const double arm = axis.point.norm();
  const double sizes = hung.head<3>().norm() + on_foot.head<3>().norm() +
                       arm * (hung.tail<3>().norm() + on_foot.tail<3>().norm());
  const double along = std::abs(axis.direction.dot(moment));
  const double across = axis.direction.cross(moment).norm();
  double drift = h * std::abs(axis.direction.dot(weighted.rate)) + weighted.rest +
                 axis.turned * (across + weighted.Norm(h)) +
                 0.5 * axis.turned * axis.turned * along;
  // Of sums at m, with twice the floor's forces for its share.
  drift += 2.0 * drift_.rounding.OfSums(axis.point).moment + 64.0 * kRoundoff * sizes;
  if (!loads_.both()) return drift;
  // The shares drift, and with them the couple λ(1 − λ) (f_z (c_R − c_L) − rise f_t) × ẑ.
  const double push = at_m_.contact()[5], product = share * (1.0 - share);
  const double most_push = at_m_.contact().tail<3>().norm() + drift_.ForceDrift();
  const double product_drift = share_drift_ * (std::abs(1.0 - 2.0 * share) + share_drift_);
  double couple_drift = loads_.between().norm() * (product_drift * (push + drift_.ForceDrift()) +
                                                   product * drift_.ForceDrift());
  if (loads_.rise() != 0.0) {
    const double rise = loads_.rise();
    const double arm = std::sqrt(loads_.between().squaredNorm() + rise * rise);
    const Eigen::Vector2d factor = push * loads_.between() - rise * at_m_.contact().segment<2>(3);
    couple_drift = product_drift * (factor.norm() + arm * drift_.ForceDrift()) +
                   product * arm * drift_.ForceDrift();
  }
  const Vector3d of_all = MomentAbout(axis.point, at_m_.contact());
  const double along_all = std::abs(axis.direction.dot(of_all)) + axis.turned * of_all.norm();
  // Of the way between soles, and of the rise.
  couple_drift += (product + product_drift) * 3.0 * soles_off_ * most_push;
  return drift + share_drift_ * (along_all + all.Norm(h)) + couple_drift;
}

Vector6d TorqueDrift::Of(Side side) const {
  if (!drift_.rounding.known) return Vector6d::Constant(HUGE_VAL);
  Vector6d drifts;
  for (Eigen::Index j = 0; j < 6; ++j) drifts[j] = OfJoint(side, static_cast<size_t>(j));
  return drifts;
}

}  // namespace halfstep
