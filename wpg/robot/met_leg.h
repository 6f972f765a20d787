#pragma once

#include <Eigen/Core>
#include <vector>

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The point nearest to lines through `points` [m] along the unit vectors `axes`, by least squares
/// with `weights`.
Eigen::Vector3d NearestPoint(const std::vector<Eigen::Vector3d>& axes,
                             const std::vector<Eigen::Vector3d>& points,
                             const std::vector<double>& weights);

/// The leg with hip and ankle axes moved in parallel so that they meet, and with the same frames of
/// knee and sole in the standing posture: `Leg::met`. There the axes meet where those pass that are
/// parallel to the knee's, which turn most while walking; the others weigh little.
Leg WithAxesThatMeet(const Leg& leg);

}  // namespace halfstep
