#pragma once

#include <vector>

#include "planner/collision/separation.h"
#include "wpg/motion/half_step_sequence.h"
#include "wpg/motion/posture.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

inline constexpr double kStride = 0.3;  ///< of SixSteps at most, over the leg's length ℓ

/// Six steps straight ahead, feet side by side in the end: of 0.3 of the leg's length ℓ, or of the
/// largest smaller multiple of 0.025 ℓ for which the sampled planned motion is within reach and
/// limits of the legs. `prototype` gives duration, via point and shape.
HalfStepSequence SixSteps(const RobotModel& robot, const HalfStep& prototype);

/// Whether the sampled planned motion of a sequence is within reach and limits of the legs.
bool IsWithinReach(const RobotModel& robot, const HalfStepSequence& sequence);

/// The posture of standing, and some of the planned motion of a sequence; those that the legs do
/// not reach are left out.
std::vector<Posture> SampledPostures(const RobotModel& robot, const HalfStepSequence& sequence);

/// How near two bodies of a robot come to each other.
struct SelfGap {
  int a = -1, b = -1;     ///< indices of RobotModel::bodies
  double standing = 0.0;  ///< distance in the first posture [m]
  double least = 0.0;     ///< in all of them [m]
};

/// Distances of a robot's bodies in sampled postures; for guesses, nothing is proved by it.
class SelfGaps {
 public:
  /// Borrows the robot, which must outlive this.
  SelfGaps(const RobotModel& robot, std::vector<Posture> postures);

  /// The watched pairs that come nearer than `enough` [m].
  std::vector<SelfGap> Nearer(double enough) const;

  /// The least distance [m], at most `enough`, of the bodies `moved` (rigid with the waist), each
  /// displaced by its X_B, from all bodies of the legs.
  double FromLegs(const std::vector<int>& moved, const std::vector<Eigen::Isometry3d>& X_B,
                  double enough) const;

 private:
  double Distance(int a, const Eigen::Isometry3d& X_Wa, int b, const Eigen::Isometry3d& X_Wb,
                  double enough) const;

  const RobotModel& robot_;
  const std::vector<Posture> postures_;
  std::vector<CollisionShape> shapes_;  // of the bodies
};

}  // namespace halfstep
