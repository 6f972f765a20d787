#include "wpg/motion/robot_drift.h"

#include <cmath>

namespace halfstep {

RobotDrift::RobotDrift(const RobotModel& robot, const IntervalMotion& motion,
                       const WalkThirds& thirds, const RobotDynamics& at_m, double gravity)
    : rounding(DynamicsRounding::At(robot, motion, at_m, gravity)),
      waist(DriftOfWaist(robot, motion, thirds)) {
  if (!rounding.known) {
    for (LegDrift& leg : legs) {
      for (JointDrift& joint : leg.joints) joint.acceleration_drift = HUGE_VAL;
    }
    return;
  }
  const Eigen::Vector3d origin = motion.posture.X_WB.translation();
  const auto mass = [&](const RobotDynamics::Body& body, const RigidDrift& drift,
                        const Eigen::Vector3d& point, const BodyRounding& off) {
    const double distance = (at_m.O() + body.inertia.com - point).norm() + 2.0 * off.place;
    return MassDrift::Of(body, drift.At(distance), gravity, off);
  };
  waist_mass = mass(at_m.waist(), waist, origin, rounding.waist);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const size_t s = static_cast<size_t>(Index(side));
    legs[s] =
        LegDrift::Over(side, motion, waist, DriftOfSole(motion, thirds, side), at_m, rounding);
    for (size_t j = 0; j < 6; ++j) {
      link_masses[s][j] =
          mass(at_m.leg(side)[j], legs[s].links[j], legs[s].points[j], rounding.legs[s][j]);
    }
  }
}

double RobotDrift::ForceDrift() const {
  double drift = rounding.sums.force + waist_mass.mass * waist_mass.p2;
  for (const auto& leg : link_masses) {
    for (const MassDrift& link : leg) drift += link.mass * link.p2;
  }
  return drift;
}

// A weight has no moment about a vertical line.
double RobotDrift::YawMomentDrift(const Eigen::Vector3d& point) const {
  double drift = rounding.OfSums(point).moment;
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
