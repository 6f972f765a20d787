#pragma once

#include <array>

#include "experiments/verify/described_walk.h"

namespace halfstep::verify {

/// q̈ of both legs by Index(Side) [rad/s²] at an instant of a walk: differences of eighth order of
/// the joint angles that inverse kinematics gives while the walk's quantities go along the parabola
/// that they describe there. Not a number where a leg does not reach on it. Nothing of the
/// Jacobians that the prover uses.
std::array<Vector6d, 2> JointAccelerations(const DescribedWalk& walk, double t);

/// A joint's limit − |q̈| [rad/s²]: +∞ where the robot file states none, −∞ where a leg does not
/// reach. `side` is Index(Side).
double JointAccelerationMargin(const DescribedWalk& walk, double t, size_t side, size_t joint);
/// The least of all joints of both legs; +∞, unasked, where the robot file states no limit.
double LeastJointAccelerationMargin(const DescribedWalk& walk, double t);

}  // namespace halfstep::verify
