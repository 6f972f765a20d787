#pragma once

#include <array>
#include <vector>

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/described_walk.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/played_motion.h"

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

/// Whether the joints' accelerations keep what is demanded at the rows' times, by the walk. Nothing
/// is looked at, or said, where the robot file states no limit.
void CheckJointAccelerations(const std::vector<PlayedRow>& rows, const DescribedWalk& walk,
                             const CertificateText& certificate, Findings* findings);

}  // namespace halfstep::verify
