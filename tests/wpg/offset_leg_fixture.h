#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "tests/wpg/generated_robots.h"
#include "wpg/robot/leg_ik.h"

namespace halfstep {

/// The pose of a sole that is level.
inline Eigen::Isometry3d LevelSole(const Eigen::Vector4d& xyz_yaw) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = xyz_yaw.head<3>();
  X.rotate(Eigen::AngleAxisd(xyz_yaw[3], Eigen::Vector3d::UnitZ()));
  return X;
}

/// A test of each robot whose hip or ankle axes do not meet.
class OffsetLegTest : public testing::TestWithParam<int> {
 protected:
  OffsetLegTest()
      : robot_(TemporaryRobot(OffsetRobots()[static_cast<size_t>(GetParam())]).Load()),
        size_(robot_.waist_height / 0.65) {}

  // x, y, z, yaw of a sole about where it stands, as walking asks for it.
  Eigen::Vector4d DrawSole(const Leg& leg) {
    std::uniform_real_distribution<> unit(-1, 1);
    Eigen::Vector4d sole;
    sole << LegForwardKinematics(leg, leg.standing_q)[6].translation(), 0.4 * unit(random_);
    sole.head<3>() += size_ * Eigen::Vector3d(0.25 * unit(random_), 0.12 * unit(random_),
                                              0.09 * (1 + unit(random_)));
    return sole;
  }

  RobotModel robot_;
  double size_;  // of the robot, HRP-2: 1
  std::mt19937 random_{20261123};
};

}  // namespace halfstep
