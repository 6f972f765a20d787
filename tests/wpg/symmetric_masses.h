#pragma once

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The robot with masses that are their own mirror image in the xz plane of the waist: the right
/// leg's are those of the left one. HRP-2's links are no mirror images of each other to the last
/// digit.
inline RobotModel WithSymmetricMasses(RobotModel robot) {
  const Eigen::DiagonalMatrix<double, 3> mirror(1, -1, 1);
  BodyMass& waist = robot.masses.waist;
  waist.com.y() = 0;
  for (const int k : {0, 2}) waist.inertia(1, k) = waist.inertia(k, 1) = 0;
  for (size_t j = 0; j < 6; ++j) {
    const BodyMass& left = robot.masses.links[0][j];
    const Eigen::Matrix3d R = robot.legs[1].joints[j].X_BLink.linear().transpose() * mirror *
                              robot.legs[0].joints[j].X_BLink.linear();
    // Seen from B at q = 0.
    const Eigen::Vector3d com = mirror * (robot.legs[0].joints[j].X_BLink * left.com);
    robot.masses.links[1][j] = {left.mass, robot.legs[1].joints[j].X_BLink.inverse() * com,
                                R * left.inertia * R.transpose()};
  }
  return robot;
}

}  // namespace halfstep
