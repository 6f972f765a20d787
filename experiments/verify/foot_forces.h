#pragma once

#include <Eigen/Core>
#include <array>

#include "experiments/verify/played_motion.h"
#include "experiments/verify/robot_momentum.h"

namespace halfstep::verify {

/// What the floor gives each foot, by Index(Side). A foot that stands alone gets all of it. Where
/// both stand, a foot gets a share of the force at a ZMP of its own: shares are as the distances of
/// the robot's ZMP from the other foot's sole and from its own, and both ZMPs are as far, and that
/// way, from the centres of their soles. Written from wpg/README.md, "What each foot carries".
std::array<Push, 2> FootForces(const RobotModel& robot, const PlayedRow& row,
                               const RobotMomentum& momentum, const FlatFloor& floor);

/// Torques of the joints of both legs, by Index(Side) [N m].
std::array<Vector6d, 2> JointTorques(const RobotModel& robot, const PlayedRow& row,
                                     const RobotMomentum& momentum, const FlatFloor& floor);

/// The friction coefficient that is needed, of a pressure on two points of the support polygon as
/// far before the ZMP as behind it, along the edge that lets them be farthest; ∞ where the ZMP is
/// not inside. Written from wpg/README.md, "Friction that is needed".
double FrictionNeeded(const RobotModel& robot, const PlayedRow& row, const RobotMomentum& momentum,
                      const FlatFloor& floor);

}  // namespace halfstep::verify
