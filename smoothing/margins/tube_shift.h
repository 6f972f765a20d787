#pragma once

#include <vector>

#include "smoothing/margins/tube.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// How far the parts of a robot may be from where they are planned, anywhere in a tube and in any
/// posture, rounded up. Source: smoothing/README.md, "Tubes".
struct TubeShift {
  /// Of a robot in a tube; nothing is borrowed.
  TubeShift(const RobotModel& robot, const Tube& its_tube);

  Tube tube;                   ///< as given
  std::vector<double> bodies;  ///< any point of each of RobotModel::bodies [m]
  std::vector<double> pairs;   ///< how much nearer those of RobotModel::self_pairs may be [m]
  double body = 0.0;           ///< the largest of `bodies` [m]
  double off_feet = 0.0;       ///< the largest of those that are not on a foot [m]
  double pair = 0.0;           ///< the largest of `pairs` [m]
  double sole = 0.0;           ///< any point of a sole's outline [m]
};

}  // namespace halfstep
