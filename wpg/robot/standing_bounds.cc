#include "wpg/robot/standing_bounds.h"

#include <algorithm>
#include <array>

#include "wpg/nth.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

Eigen::AlignedBox3d StandingBounds(const RobotModel& robot) {
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  X_WB.translation().z() = robot.waist_height;
  const std::array<LegFrames, 2> legs = {PlaceLeg(robot.legs[0], robot.legs[0].standing_q),
                                         PlaceLeg(robot.legs[1], robot.legs[1].standing_q)};
  Eigen::AlignedBox3d bounds;
  for (const RobotBody& body : robot.bodies) {
    const Eigen::Isometry3d X_WBody =
        body.leg < 0 ? X_WB : X_WB * Nth(Nth(legs, body.leg).X_BLink, body.link);
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d d = Eigen::Vector3d::Unit(axis);
      const Eigen::Vector3d d_Body = X_WBody.linear().transpose() * d;
      const double at = X_WBody.translation()[axis];
      bounds.max()[axis] = std::max(bounds.max()[axis], at + Support(body.shape, d_Body));
      bounds.min()[axis] = std::min(bounds.min()[axis], at - Support(body.shape, -d_Body));
    }
  }
  return bounds;
}

}  // namespace halfstep
