#include "wpg/motion/mass_drift.h"

#include <algorithm>

namespace halfstep {

MassDrift MassDrift::Of(const RobotDynamics::Body& body, const RigidDrift& of_com, double gravity) {
  const SpatialInertia& inertia = body.inertia;
  MassDrift drift{.mass = inertia.mass, .com = inertia.com, .p = of_com.p, .p2 = of_com.p2};
  const Eigen::Vector3d turn = body.velocity.head<3>(), &com = inertia.com;
  drift.velocity = body.velocity.tail<3>() + turn.cross(com);
  drift.acceleration = body.acceleration.tail<3>() + body.acceleration.head<3>().cross(com) +
                       turn.cross(drift.velocity) - gravity * Eigen::Vector3d::UnitZ();
  // By the product rule, ‖R I Rᵀ − I‖ ≤ ‖R − 1‖·‖I‖; R I Rᵀ has the norm of I.
  const double norm = inertia.about_com.norm(), change = std::min(of_com.turned, 2.0) * norm;
  const double fastest = of_com.fastest();
  drift.moment = norm * of_com.turn1 + change * of_com.acceleration + of_com.turn * norm * fastest +
                 of_com.speed * (norm * of_com.turn + change * fastest);
  return drift;
}

}  // namespace halfstep
