#pragma once

#include <string>
#include <vector>

#include "experiments/survey/self_gaps.h"
#include "wpg/robot/urdf_file.h"

namespace halfstep {

/// A joint outside the legs that is turned so that its limb keeps off the legs.
struct ArmTurn {
  int joint = -1;      ///< URDF joint index
  double angle = 0.0;  ///< [rad], within its limits
  std::string why;     ///< what the turn is good for, for the robot file's comment
};

/// Which of the robot's bodies belong to limbs beside the plane of symmetry, the legs excepted.
std::vector<bool> BodiesOfLimbs(const UrdfTree& urdf, int waist, const std::vector<double>& posture,
                                const RobotModel& robot);

/// For each limb beside the plane of symmetry that comes nearer to the legs than `apart` [m] in the
/// sampled postures: the joint of it, among those nearest to the waist, that keeps it off with the
/// least turn, by steps of 5° up to 90°; else the one that keeps it off best. `posture` has the
/// present angles by URDF joint index.
std::vector<ArmTurn> KeepArmsOff(const UrdfTree& urdf, int waist,
                                 const std::vector<double>& posture, const RobotModel& robot,
                                 const SelfGaps& gaps, double apart);

}  // namespace halfstep
