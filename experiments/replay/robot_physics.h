#pragma once

#include "experiments/config/replay_config.h"
#include "experiments/replay/mujoco_model.h"
#include "experiments/replay/player.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::replay {

/// How many times as large as HRP-2's these are: leg length ℓ/0.705 m, mass m/56.9 kg, and times,
/// √(ℓ/0.705 m), since all robots fall by the same g; ℓ and m to three digits.
struct RobotScale {
  double length = 1.0;  ///< of distances
  double mass = 1.0;    ///< of masses
  double time = 1.0;    ///< of durations

  double torque() const { return mass * length; }            ///< of torques, by angles as well
  double inertia() const { return mass * length * length; }  ///< of moments of inertia
  double impulse() const { return mass * length / time; }    ///< of forces times durations
};
/// Of a robot by its masses and its left leg.
RobotScale ScaleOf(const RobotModel& robot);

/// Servos, rotors, contacts and time step of a robot's size, to three digits (of HRP-2 those of
/// ModelOptions): stiffness K ∝ m ℓ, rotor inertia ∝ m ℓ², damping ∝ m ℓ √ℓ, so that the damping
/// ratio D/√(K I) stays, contacts' time constant ∝ √ℓ. The time step is HRP-2's over the least
/// whole number that makes it no more than HRP-2's times √(ℓ/0.705 m).
/// Documented in experiments/replay.md, "Replay".
ModelOptions PhysicsOf(const RobotModel& robot);
/// The same with what a config or the command's options say.
ModelOptions PhysicsOf(const RobotModel& robot, const ReplayConfig& config);

/// How its walks are played: PlayOptions with its distances scaled.
PlayOptions PlayOptionsOf(const RobotModel& robot);

}  // namespace halfstep::replay
