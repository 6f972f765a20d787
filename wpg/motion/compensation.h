#pragma once

#include "wpg/motion/half_step_sequence.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The motion of the waist that brings the ZMP of the whole robot back towards the planned one in
/// this half-step, when it is executed alone. Each of the `iterations` adds the motion d that makes
///
///     Σ ‖ p_robot − p_planned + Z(d) ‖²
///
/// least over 121 instants of the half-step as it is planned, of one 1/√2 and one half as long,
/// p_robot being the robot's ZMP with what was added before: a Newton iteration that takes the
/// robot for the point mass Z(d) = d − (z_c/g)·d̈. The form d(σ) is the same at all durations. A leg
/// keeps at least half of what it has left to stretch: else the motion is halved, or left out. No
/// motion where a leg does not reach, or `iterations` is 0. Preconditions: the robot's masses are
/// known, iterations ≥ 0 (std::logic_error). Source: wpg/README.md, "Compensation".
WaistSway Compensation(const RobotModel& robot, const HalfStep& half_step, const Lipm& lipm,
                       int iterations);

/// The sequence whose half-steps have their compensations in place of what they had.
HalfStepSequence Compensated(const RobotModel& robot, const HalfStepSequence& sequence,
                             int iterations);

}  // namespace halfstep
