#pragma once

#include <Eigen/Core>
#include <array>

#include "experiments/verify/played_motion.h"
#include "experiments/verify/robot_momentum.h"

namespace halfstep::verify {

/// How far the line of the points about which the ground's force has no horizontal moment may be
/// moved aside before it misses the soles' hull in space [m]; negative outside. On one level: the
/// margin of the robot's ZMP. Else all is projected along the force to the plane of the left sole,
/// in which that sole is its own shadow. Written from wpg/README.md, "Soles at different heights".
double RobotZmpMargin(const RobotModel& robot, const PlayedRow& row, const RobotMomentum& momentum);

/// What the floor gives each foot, by Index(Side). A foot that stands alone gets all of it. Where
/// both stand, a foot gets a share of the force at a ZMP of its own: shares are as the distances of
/// the robot's ZMP from the other foot's sole and from its own, and both ZMPs are as far, and that
/// way, from the centres of their soles. Where soles stand at different heights, the ZMP is that in
/// the plane of each sole; infinite where it is inside both, so that nothing says which one
/// carries. Written from wpg/README.md, "What each foot carries" and "Soles at different heights".
std::array<Push, 2> FootForces(const RobotModel& robot, const PlayedRow& row,
                               const RobotMomentum& momentum);

/// Torques of the joints of both legs, by Index(Side) [N m].
std::array<Vector6d, 2> JointTorques(const RobotModel& robot, const PlayedRow& row,
                                     const RobotMomentum& momentum);

/// The friction coefficient that is needed, of a pressure on two points of the support polygon as
/// far before the ZMP as behind it, along the edge that lets them be farthest; ∞ where the ZMP is
/// not inside. Where soles stand at different heights, of the section between them that lets the
/// points be farthest, with a disc of a quarter of that way around the ZMP. Written from
/// wpg/README.md, "Friction that is needed" and "Soles at different heights".
double FrictionNeeded(const RobotModel& robot, const PlayedRow& row, const RobotMomentum& momentum);

}  // namespace halfstep::verify
