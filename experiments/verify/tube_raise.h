#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "experiments/config/smoothing_config.h"
#include "experiments/verify/certificate_text.h"
#include "experiments/verify/findings.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// How far the bodies of a robot may be from where they are planned in a tube, in all postures.
struct BodyWays {
  /// All 0 for a tube of 0.
  BodyWays(const Tube& tube, const RobotModel& robot);

  std::vector<double> bodies;  ///< any point of each of RobotModel::bodies [m]
  Eigen::MatrixXd nearer;      ///< how much nearer bodies a and b may be, at (a, b) [m]
};

/// How much less the margins of each family may be within a tube than on the walk, for all of its
/// motions and all postures of the robot [unit of the family]; 0 of families that hold of the walk
/// alone, and of clearances, whose margins are less by BodyWays. Source: smoothing/README.md,
/// "Tubes".
std::array<double, kNumFamilies> FallInTube(const Tube& tube, const RobotModel& robot);

/// What a config demands, with what its tube takes from the margins of this robot.
MarginLimits WithTube(const SmoothingConfig& config, const RobotModel& robot);

/// Whether the tube of a certificate is that of the run's config, and what it says to have raised
/// is what the robot needs.
void CheckTube(const CertificateText& certificate, const SmoothingConfig& config,
               const RobotModel& robot, Findings* findings);

}  // namespace halfstep::verify
