#pragma once

#include <string>
#include <vector>

#include "experiments/survey/self_gaps.h"
#include "wpg/robot/urdf_file.h"

namespace halfstep {

/// A joint outside the legs that is turned so that its limb hangs or keeps off the legs.
struct ArmTurn {
  int joint = -1;      ///< URDF joint index
  double angle = 0.0;  ///< [rad], within its limits
  std::string why;     ///< what the turn is good for, for the robot file's comment
};

/// Which of the robot's bodies belong to limbs beside the plane of symmetry, the legs excepted.
std::vector<bool> BodiesOfLimbs(const UrdfTree& urdf, int waist, const std::vector<double>& posture,
                                const RobotModel& robot);

/// For each limb beside the plane of symmetry that stretches farther to the side than in height:
/// the joint of it, among the first four from the waist, that lowers its centre of mass most, by
/// steps of 5° up to 90°, and leaves it `apart` [m] from what is neither of it nor of the legs and
/// was so far from it before. `posture` has the present angles by URDF joint index.
std::vector<ArmTurn> LowerArms(const UrdfTree& urdf, int waist, const std::vector<double>& posture,
                               const std::vector<RobotBody>& bodies, double apart);

/// For each limb beside the plane of symmetry that comes nearer to the legs than `apart` [m] in the
/// sampled postures: the joint of it, among the first four, that keeps it off with the least turn,
/// by steps of 5° up to 90°; else the one that keeps it off best.
std::vector<ArmTurn> KeepArmsOff(const UrdfTree& urdf, int waist,
                                 const std::vector<double>& posture, const RobotModel& robot,
                                 const SelfGaps& gaps, double apart);

}  // namespace halfstep
