#include "wpg/motion/mass_drift.h"

namespace halfstep {

MassDrift MassDrift::Of(const RobotDynamics::Body& body, const RigidDrift& of_com, double gravity,
                        const BodyRounding& off) {
  const SpatialInertia& inertia = body.inertia;
  MassDrift drift{.mass = inertia.mass, .com = inertia.com};
  const Eigen::Vector3d turn = body.velocity.head<3>(), &com = inertia.com;
  drift.velocity = body.velocity.tail<3>() + turn.cross(com);
  drift.acceleration = body.acceleration.tail<3>() + body.acceleration.head<3>().cross(com) +
                       turn.cross(drift.velocity) - gravity * Eigen::Vector3d::UnitZ();
  drift.off = off.Of(body, com);
  drift.p = of_com.p + drift.off.place;
  drift.p2 = of_com.p2 + drift.off.acceleration;
  drift.moment = InertialMomentChange(body, of_com.turned + off.turn, of_com.turn + off.spin,
                                      of_com.turn1 + off.spin1);
  return drift;
}

}  // namespace halfstep
