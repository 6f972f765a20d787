#include "wpg/motion/robot_drift.h"

namespace halfstep {

RobotDrift::RobotDrift(const RobotModel& robot, const IntervalMotion& motion,
                       const WalkThirds& thirds, const RobotDynamics& at_m, double gravity)
    : waist(DriftOfWaist(robot, motion, thirds)) {
  const auto from = [&](const SpatialInertia& inertia, const Eigen::Vector3d& point) {
    return (at_m.O() + inertia.com - point).norm();
  };
  const Eigen::Vector3d origin = motion.posture.X_WB.translation();
  waist_mass = MassDrift::Of(at_m.waist(), waist.At(from(at_m.waist().inertia, origin)), gravity);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const size_t s = static_cast<size_t>(Index(side));
    legs[s] = LegDrift::Over(side, motion, waist, DriftOfSole(motion, thirds, side), at_m);
    for (size_t j = 0; j < 6; ++j) {
      const RobotDynamics::Body& link = at_m.leg(side)[j];
      link_masses[s][j] =
          MassDrift::Of(link, legs[s].links[j].At(from(link.inertia, legs[s].points[j])), gravity);
    }
  }
}

double RobotDrift::ForceDrift() const {
  double drift = waist_mass.mass * waist_mass.p2;
  for (const auto& leg : link_masses) {
    for (const MassDrift& link : leg) drift += link.mass * link.p2;
  }
  return drift;
}

// A weight has no moment about a vertical line.
double RobotDrift::YawMomentDrift(const Eigen::Vector3d& point) const {
  double drift = 0.0;
  const auto add = [&](const MassDrift& body) {
    const double arm = (body.com - point).head<2>().norm();
    drift += body.mass * (arm * body.p2 + body.p * body.MostAcceleration()) + body.moment;
  };
  add(waist_mass);
  for (const auto& leg : link_masses) {
    for (const MassDrift& link : leg) add(link);
  }
  return drift;
}

}  // namespace halfstep
