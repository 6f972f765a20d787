#pragma once

#include "smoothing/margins/margin.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The least margin of a family in the six steps that a robot would take by default (SixSteps), in
/// the family's unit, looked at every `period` [s]. For guesses: nothing is proved by it. Instants
/// at which a leg does not reach count only if asked for `everywhere`.
double LeastInSixSteps(const RobotModel& robot, MarginFamily family, double period,
                       bool everywhere = true);

/// Where in the support sole CoM and ZMP shall rest on one foot, and what was missed elsewhere.
struct FoundSupport {
  double offset = 0.0;                            ///< RobotModel::support_point [m]
  MarginFamily missed = MarginFamily::kZmpRobot;  ///< kZmpRobot or kTorque
  double before = 0.0;                            ///< its least margin without it [its unit]
  double after = 0.0;                             ///< and with it
};

/// Where the whole robot's ZMP is not as far inside the support polygon in six steps, or a joint's
/// torque not as far inside its limit, as is demanded by default: the support point, in whole
/// millimetres, with which these, the point mass's ZMP and the joints' angles have most slack
/// (MarginLimits::Slack).
/// Offset 0 where nothing is missed, where the robot's masses are not known, or where no other
/// offset is better.
FoundSupport FindSupport(RobotModel robot);

}  // namespace halfstep
