#include "experiments/replay/disturbance.h"

#include <numbers>

#include "experiments/replay/robot_physics.h"
#include "wpg/elementary.h"

namespace halfstep::replay {

ModelOptions Disturbance::Applied(ModelOptions model) const {
  model.friction = friction;
  model.contact_time = contact_time;
  model.stiffness *= stiffness_share;
  model.com_shift = com_shift;
  return model;
}

Disturbance DrawDisturbance(const RobotModel& robot, double duration, SeedDraws* draws) {
  constexpr double kComShift = 0.01;  // of HRP-2 [m]
  constexpr double kImpulse = 2.0;    // [N s]
  const RobotScale scale = ScaleOf(robot);
  const double contact_time = PhysicsOf(robot).contact_time, shift = kComShift * scale.length;
  Disturbance drawn;
  drawn.friction = draws->Between(0.5, 0.8);
  drawn.contact_time = draws->Between(contact_time, 2 * contact_time);
  drawn.stiffness_share = draws->Between(0.9, 1.1);
  drawn.com_shift.x() = draws->Between(-shift, shift);
  drawn.com_shift.y() = draws->Between(-shift, shift);
  drawn.push.at = draws->Between(0.0, duration);
  drawn.push.duration *= scale.time;
  const double direction = draws->Between(0.0, 2 * std::numbers::pi);
  drawn.push.impulse_W =
      kImpulse * scale.impulse() * Eigen::Vector3d(Cos(direction), Sin(direction), 0.0);
  return drawn;
}

}  // namespace halfstep::replay
