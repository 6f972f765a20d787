#include "wpg/motion/torque_drift.h"

#include <algorithm>
#include <cmath>

#include "wpg/nth.h"

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
                         double gravity)
    : motion_(motion),
      drift_(drift),
      at_m_(at_m),
      loads_(loads),
      share_drift_(loads.ShareDrift(zmp_moved)),
      gravity_(gravity) {}

// The axis is fixed in both bodies that the joint joins: what drifts less counts.
TorqueDrift::Axis TorqueDrift::AxisOf(Side side, size_t joint) const {
  const size_t s = static_cast<size_t>(Index(side));
  const Posture& posture = motion_.posture;
  const LegDrift& leg = drift_.legs[s];
  const Vector3d point = posture.X_WB * posture.frames[s].point_B[joint];
  const auto at = [&](const RigidDrift& body, const Vector3d& its_point) {
    return body.At((point - its_point).norm());
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
  axis.p = std::min(above.p, below.p);
  axis.turned = std::min({above.turned, below.turned, 2.0});
  axis.most_acceleration = acceleration.norm() + std::min(above.p2, below.p2);
  return axis;
}

double TorqueDrift::OfJoint(Side side, size_t joint) const {
  const double h = motion_.half_width, share = loads_.share(side);
  const Axis axis = AxisOf(side, joint);
  MomentDrift weighted, all;
  const auto add = [&](const MassDrift& body, double weight) {
    const Vector3d rate =
        body.mass * gravity_ * (body.velocity - axis.velocity).cross(Vector3d::UnitZ());
    const double rest =
        body.mass * (0.5 * h * h * gravity_ * (body.MostAcceleration() + axis.most_acceleration) +
                     (body.com - axis.point).norm() * body.p2 +
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
  const Vector3d moment = MomentAbout(axis.point, hung - loads_.On(side, at_m_.contact()));
  const double along = std::abs(axis.direction.dot(moment));
  const double across = axis.direction.cross(moment).norm();
  double drift = h * std::abs(axis.direction.dot(weighted.rate)) + weighted.rest +
                 axis.turned * (across + weighted.Norm(h)) +
                 0.5 * axis.turned * axis.turned * along;
  if (!loads_.both()) return drift;
  // The shares drift, and with them the couple λ(1 − λ) (f_z (c_R − c_L) − rise f_t) × ẑ.
  const double push = at_m_.contact()[5], product = share * (1.0 - share);
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
  return drift + share_drift_ * (along_all + all.Norm(h)) + couple_drift;
}

Vector6d TorqueDrift::Of(Side side) const {
  Vector6d drifts;
  for (Eigen::Index j = 0; j < 6; ++j) drifts[j] = OfJoint(side, static_cast<size_t>(j));
  return drifts;
}

}  // namespace halfstep
