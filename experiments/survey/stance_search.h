#pragma once

#include <array>
#include <vector>

#include "experiments/survey/robot_draft.h"
#include "smoothing/margins/margin.h"
#include "wpg/motion/half_step.h"
#include "wpg/motion/posture.h"

namespace halfstep {

/// What the user knows of the stance.
struct StanceRequest {
  /// Distance of hip and ankle over the leg's stretched length; 0: to be found.
  double bend = 0.0;
  double width = 0.0;  ///< distance of the sole centres [m]; 0: to be found
};

/// The half-step that a config without numbers would give this robot.
HalfStep DefaultHalfStep(const RobotModel& robot);

/// What such a config would demand of its walks.
MarginLimits DefaultLimits(const RobotModel& robot);

/// The robot's sampled postures in six steps of that half-step.
std::vector<Posture> WalkedPostures(const RobotModel& robot);

/// Finds how a draft, whose legs and soles are known, stands, so that the legs touch neither each
/// other nor the trunk in six steps: cuts meshes into parts whose hulls touch; bends the knees less
/// where the joints' limits keep the swing foot low or their torques are too small, as long as the
/// legs reach in six steps; and takes the narrowest stance at which a swing foot that is lifted by
/// default, or down to 0.6 of that, is enough, or else the best one; and moves the support points
/// where the whole robot's ZMP comes too near to the soles' edges. Writes posture, stance, lift,
/// parts and support point into the draft, with their reasons, and returns the model. Throws
/// InputError when the robot cannot stand.
RobotModel StandApart(const StanceRequest& request, const std::array<Leg, 2>& legs,
                      const std::vector<RobotBody>& bodies, RobotDraft* draft);

}  // namespace halfstep
