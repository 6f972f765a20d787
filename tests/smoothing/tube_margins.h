#pragma once

#include <algorithm>
#include <cmath>
#include <map>

#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/motion/posture.h"
#include "wpg/nth.h"

namespace halfstep {

/// The pose of a sole on the floor.
inline Pose2 SeenFromAbove(const Eigen::Isometry3d& X) {
  return {X.translation().x(), X.translation().y(), std::atan2(X(1, 0), X(0, 0))};
}

/// All that a tube is about, of one posture: by family, the least margin.
inline std::map<MarginFamily, double> TubeMarginsOf(const MarginEvaluator& evaluator,
                                                    const Posture& posture,
                                                    const SuperposedWalk& walk,
                                                    const LocalTime& at) {
  const RobotModel& robot = evaluator.robot();
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  const BodyClearances& clearances = evaluator.clearances();
  std::map<MarginFamily, double> margins;
  margins[MarginFamily::kClearance] =
      clearances.NearestObstacle(posture, walk.Absolute(at), 0.3, &scratch.bodies).value;
  margins[MarginFamily::kSelfClearance] =
      clearances.NearestPair(posture, 0.3, &scratch.bodies).value;
  double joint = kUnlimited, ground = kUnlimited, floor = kUnlimited, no_step = kUnlimited;
  for (size_t s = 0; s < 2; ++s) {
    for (int j = 0; j < 6; ++j) {
      const LegJoint& limits = Nth(robot.legs[s].joints, j);
      const double q = posture.ik[s].q[j];
      joint = std::min({joint, q - limits.lower, limits.upper - q});
    }
    const Eigen::Isometry3d& X_WS = posture.X_WLink[s][6];
    const Side side = static_cast<Side>(s);
    if (!walk.InAir(at, side)) {
      no_step = std::min(no_step, evaluator.place().areas.NearestTo(SeenFromAbove(X_WS)).distance);
      continue;
    }
    const int step = at.half_step / 2;
    if (!walk.MovesHorizontally(step, at)) continue;
    for (Eigen::Index k = 0; k < robot.sole_outline.cols(); ++k) {
      const Eigen::Vector2d c = robot.sole_outline.col(k);
      floor = std::min(floor, (X_WS * Eigen::Vector3d(c.x(), c.y(), 0.0)).z());
    }
  }
  for (const RobotBody& body : robot.bodies) {
    if (IsOnFoot(body)) continue;
    const Eigen::Isometry3d& X = posture.OfBody(body);
    const Eigen::Vector3d down = X.linear().transpose() * -Eigen::Vector3d::UnitZ();
    ground = std::min(ground, X.translation().z() - Support(body.shape, down));
  }
  margins[MarginFamily::kJoint] = joint;
  margins[MarginFamily::kGround] = ground;
  margins[MarginFamily::kFloor] = floor;
  margins[MarginFamily::kNoStep] = no_step;
  return margins;
}

}  // namespace halfstep
