#include "wpg/motion/zmp_drift.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/motion/leg_motion.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// Adds a link: m (r − p) × a + I ω̇ + ω × I ω by how much it drifts,
// its weight's moment m (r − p) × g ẑ by its rate at m and half h² times the acceleration.
void AddLink(const MassDrift& link, const Vector3d& arm, double gravity, ZmpDrift* drift) {
  const double h = drift->half_width, most = link.MostAcceleration();
  drift->rate.center += link.mass * gravity * link.velocity.cross(Vector3d::UnitZ());
  drift->rest += link.mass * (0.5 * h * h * gravity * most + arm.norm() * link.p2 + link.p * most);
  drift->least_push -= link.mass * link.p2;
  drift->rest += link.moment;
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

ZmpDrift ZmpDrift::At(const ContactRate& rate, double push) {
  return {
      .half_width = rate.half_width,
      .rate = rate.moment,
      .rest = 0.0,
      .least_push = push - rate.half_width * (std::abs(rate.force.center.z()) + rate.force.radius)};
}

ZmpDrift ZmpDrift::Over(const RobotModel& robot, const IntervalMotion& motion,
                        const WalkThirds& thirds, const RobotDrift& of_robot,
                        const RobotDynamics& at_m, double gravity) {
  const Vector3d& O = at_m.O();
  Vector3d pole(0, 0, 0);
  pole.head<2>() = *at_m.Zmp();
  const RigidMotion waist = MotionOfWaist(robot, motion, thirds);
  const SpatialInertia& of_waist = at_m.waist().inertia;
  const RigidMotion body = waist.At(O + of_waist.com - waist.p.center);
  ContactRate of_body;
  of_body.Add(of_waist, body, pole, gravity);
  ZmpDrift drift{.half_width = motion.half_width,
                 .rate = of_body.moment,
                 .rest = 0.0,
                 .least_push = at_m.contact()[5] - of_waist.mass * body.p2.radius};
  for (const auto& leg : of_robot.link_masses) {
    for (const MassDrift& link : leg) AddLink(link, O + link.com - pole, gravity, &drift);
  }
  return drift;
}

}  // namespace halfstep
