#pragma once

#include <gtest/gtest.h>

#include "tests/wpg/hrp2.h"
#include "wpg/motion/robot_dynamics.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

constexpr double kEarth = 9.81;  ///< [m/s²]

/// What the floor gives: a pull and a push, and a yaw moment about the ZMP on z = 0.
struct Given {
  Eigen::Vector2d zmp{0, 0}, pull{0, 0};
  double turn = 0.0, push = 0.0;
};

/// The robot at rest on both feet.
inline WalkJet Standing(const RobotModel& robot) {
  WalkJet still;
  still.value[kLeftY] = 0.5 * robot.standing_width;
  still.value[kRightY] = -0.5 * robot.standing_width;
  return still;
}

/// A robot of which only the waist has mass, and that on the floor below the CoM, so that it can
/// ask for whatever the floor is to give.
class AskingRobot {
 public:
  AskingRobot() : robot_(LoadRobot(kHrp2)) {
    for (auto& leg : robot_.masses.links) leg.fill({});
    robot_.masses.waist = {.mass = 0.0,
                           .com = {robot_.com_x_B, 0.0, -robot_.waist_height},
                           .inertia = Eigen::Vector3d(0, 0, 1).asDiagonal()};
    jet_ = Standing(robot_);
  }

  RobotDynamics That(const Given& given) {
    robot_.masses.waist.mass = given.push / kEarth;
    WalkJet jet = jet_;
    jet.value.segment<2>(kComX) = given.zmp;
    jet.second.segment<2>(kComX) = given.pull * (kEarth / given.push);
    jet.second[kWaistYaw] = given.turn;
    Posture posture = SolvePosture(robot_, jet.value);
    EXPECT_TRUE(posture.reachable && SolveJointSpeeds(robot_, jet, &posture));
    return {robot_, jet, posture, kEarth};
  }
  const RobotModel& robot() const { return robot_; }
  const WalkJet& still() const { return jet_; }

 private:
  RobotModel robot_;
  WalkJet jet_;
};

}  // namespace halfstep
