#include "experiments/replay/robot_physics.h"

#include <algorithm>
#include <cmath>

#include "wpg/files/number_text.h"
#include "wpg/robot/reference_leg.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep::replay {
namespace {

constexpr double kMass = 56.9;  // [kg]

// To three digits: HRP-2's numbers stay what they are.
double Rounded(double value) { return Shortened(value, 3); }
double Scaled(double hrp2, double scale) { return Rounded(hrp2 * scale); }

}  // namespace

RobotScale ScaleOf(const RobotModel& robot) {
  const double length = Rounded(LegLengthOf(robot)) / kLegOfHrp2;
  return {.length = length, .mass = Rounded(robot.mass) / kMass, .time = std::sqrt(length)};
}

ModelOptions PhysicsOf(const RobotModel& robot) {
  const RobotScale scale = ScaleOf(robot);
  ModelOptions model;
  model.stiffness = Scaled(model.stiffness, scale.torque());
  model.damping = Scaled(model.damping, scale.torque() * scale.time);
  model.armature = Scaled(model.armature, scale.inertia());
  model.contact_time = Scaled(model.contact_time, scale.time);
  model.timestep /= std::ceil(std::max(1.0, 1.0 / Rounded(scale.time)));
  return model;
}

ModelOptions PhysicsOf(const RobotModel& robot, const ReplayConfig& config) {
  ModelOptions model = PhysicsOf(robot);
  if (!config.servos.empty()) {
    model.stiffness = config.servos[0];
    model.damping = config.servos[1];
  }
  if (!config.ankle.empty()) model.ankle = control::JointSpring{config.ankle[0], config.ankle[1]};
  model.torque_limits = config.torque_limits;
  return model;
}

PlayOptions PlayOptionsOf(const RobotModel& robot) {
  PlayOptions play;
  play.edge = Scaled(play.edge, ScaleOf(robot).length);
  return play;
}

}  // namespace halfstep::replay
