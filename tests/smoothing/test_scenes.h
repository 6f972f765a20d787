#pragma once

#include <utility>

#include "planner/scene/scene.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {

/// A small box, sphere or cylinder about the robot's legs; its shape is its own mirror image.
inline Obstacle RandomObstacle(WalkDraw* draw) {
  const double a = draw->Uniform(0.02, 0.1), b = draw->Uniform(0.02, 0.1);
  const double kind = draw->Uniform(0, 3);
  Obstacle obstacle;
  obstacle.name = "obstacle";
  obstacle.shape = kind < 1   ? Shape(Box{{a, b, 0.1}})
                   : kind < 2 ? Shape(Sphere{a})
                              : Shape(Cylinder{a, b});
  const Pose2 X_WO = draw->Pose(0.7, 3);
  obstacle.X_WO = ToIsometry(X_WO, draw->Uniform(0, 0.7));
  obstacle.X_WO.rotate(Eigen::AngleAxisd(draw->Uniform(-1, 1), Eigen::Vector3d::UnitX()));
  return obstacle;
}

/// The scene moved by X_VW, and seen in the mirror of W's xz plane. The shapes must be their own
/// mirror images.
inline Scene Moved(const Pose2& X_VW, Scene scene) {
  for (Obstacle& o : scene.obstacles) o.X_WO = ToIsometry(X_VW, 0.0) * o.X_WO;
  return scene;
}
inline Scene Mirrored(Scene scene) {
  const Eigen::DiagonalMatrix<double, 3> mirror(1, -1, 1);
  for (Obstacle& o : scene.obstacles) {
    o.X_WO.linear() = (mirror * o.X_WO.linear() * mirror).eval();
    o.X_WO.translation() = (mirror * o.X_WO.translation()).eval();
  }
  return scene;
}

}  // namespace halfstep
