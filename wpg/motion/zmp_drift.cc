#include "wpg/motion/zmp_drift.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/motion/leg_motion.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// Adds a link: m (r − p) × a + I ω̇ + ω × I ω by how much it drifts,
// its weight's moment m (r − p) × g ẑ by its rate at m and half h² times the acceleration. What
// rounding does to all of that at m is contained.
void AddLink(const MassDrift& link, const Vector3d& arm, double gravity, ZmpDrift* drift) {
  const double h = drift->half_width, most = link.MostAcceleration();
  drift->rate.center += link.mass * gravity * link.velocity.cross(Vector3d::UnitZ());
  drift->rest += link.mass * (gravity * (link.off.place + h * link.off.speed + 0.5 * h * h * most) +
                              arm.norm() * link.p2 + link.p * most);
  drift->least_push -= link.mass * link.p2;
  drift->rest += link.moment;
  drift->force_rest += link.mass * link.p2;
}

}  // namespace

double ZmpDrift::Most() const {
  if (!(least_push > 0.0)) return std::numeric_limits<double>::infinity();
  return (half_width * (rate.center.head<2>().norm() + rate.radius) + rest) / least_push;
}

double ZmpDrift::Along(const Eigen::Vector2d& direction) const {
  if (!(least_push > 0.0)) return std::numeric_limits<double>::infinity();
  const Vector3d& n = rate.center;
  const double along = std::abs(direction.y() * n.x() - direction.x() * n.y()) + rate.radius;
  return (half_width * along + rest) / least_push;
}

// The point p + by (tilt, 1) of that plane is on the line along f at m.
ZmpDrift ZmpDrift::Raised(double by) const {
  const Vector3d arm = by * Vector3d(tilt.x(), tilt.y(), 1.0);
  ZmpDrift raised = *this;
  raised.rate = rate - Cross({arm, 0.0}, force_rate);
  raised.rest += arm.norm() * force_rest;
  return raised;
}

ZmpDrift ZmpDrift::At(const ContactRate& rate, double push) {
  return {.half_width = rate.half_width,
          .rate = rate.moment,
          .rest = rate.off.moment,
          .least_push = push - rate.off.force -
                        rate.half_width * (std::abs(rate.force.center.z()) + rate.force.radius),
          .force_rate = rate.force,
          .force_rest = rate.off.force,
          .tilt = rate.tilt};
}

ZmpDrift ZmpDrift::Over(const RobotModel& robot, const IntervalMotion& motion,
                        const WalkThirds& thirds, const RobotDrift& of_robot,
                        const RobotDynamics& at_m, double gravity, double height) {
  if (!of_robot.rounding.known) return {};
  const Vector3d& O = at_m.O();
  Vector3d pole(0, 0, height);
  pole.head<2>() = *at_m.Zmp(height);
  const RigidMotion waist = MotionOfWaist(robot, motion, thirds);
  const SpatialInertia& of_waist = at_m.waist().inertia;
  const RigidMotion body = waist.At(O + of_waist.com - waist.p.center);
  ContactRate of_body;
  of_body.Add(of_waist, body, pole, gravity);
  const WrenchRounding off =
      DynamicsRounding::OfBody(at_m.waist(), of_robot.rounding.waist, pole - O);
  const WrenchRounding sums = of_robot.rounding.OfSums(pole - O);
  const double push = at_m.contact()[5];
  ZmpDrift drift{.half_width = motion.half_width,
                 .rate = of_body.moment,
                 .rest = off.moment + sums.moment + push * PlaceOfZmpRounding(at_m, pole),
                 .least_push = push - of_waist.mass * body.p2.radius - off.force - sums.force,
                 .force_rate = of_body.force,
                 .force_rest = off.force + sums.force,
                 .tilt = at_m.Tilt()};
  for (const auto& leg : of_robot.link_masses) {
    for (const MassDrift& link : leg) AddLink(link, O + link.com - pole, gravity, &drift);
  }
  return drift;
}

}  // namespace halfstep
