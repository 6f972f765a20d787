#pragma once

#include <cstdlib>

#include "planner/scene/scene.h"
#include "smoothing/margins/tube.h"
#include "tests/draws.h"
#include "wpg/geometry/pose2.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// How many motions to draw: a few, or as many as HALFSTEP_TUBE says.
inline int Motions(int few) {
  const char* wish = std::getenv("HALFSTEP_TUBE");
  return wish == nullptr ? Draws(few) : std::atoi(wish);
}

/// [rad]
inline constexpr double kTubeDegree = 0.017453292519943295;

/// A tube of a robot of so many times HRP-2's size.
inline Tube SomeTube(double size) {
  return {.foot = 0.005 * size,
          .foot_turn = 0.5 * kTubeDegree,
          .waist = 0.005 * size,
          .waist_turn = 0.5 * kTubeDegree,
          .joint = 0.005,
          .joint_speed = 0.1,
          .zmp = 0.01 * size};
}

/// A box beside the left foot's way and an area ahead of where the feet land.
inline Scene NarrowScene(const RobotModel& robot, double gap) {
  Scene scene;
  Obstacle box;
  box.name = "box";
  box.shape = Box{{0.1, 0.1, 0.3}};
  const double outer = 0.5 * robot.standing_width + robot.sole_outline.row(1).maxCoeff();
  box.X_WO = ToIsometry(Pose2{0.1, outer + 0.05 + gap, 0.0}, 0.15);
  scene.obstacles.push_back(box);
  Eigen::Matrix2Xd area(2, 4);
  const double x = 0.2 + robot.sole_outline.row(0).maxCoeff() + gap;
  area << x, x + 0.1, x + 0.1, x, -0.5, -0.5, 0.5, 0.5;
  scene.no_step.push_back(area);
  return scene;
}

}  // namespace halfstep
