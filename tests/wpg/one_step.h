#pragma once

#include "wpg/motion/half_step_sequence.h"
#include "wpg/motion/lipm.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Soles side by side, as the robot stands.
inline std::array<Foothold, 2> StandingFeet(const RobotModel& robot) {
  const double y = 0.5 * robot.standing_width;
  return {Foothold::Level({0, y, 0}), Foothold::Level({0, -y, 0})};
}

/// A step of the left foot, 0.2 m ahead and 0.25 m high, in two half-steps of 2 s.
inline HalfStepSequence OneStep(const RobotModel& robot) {
  return MakeSequence(StandingFeet(robot),
                      {{.side = Side::kLeft,
                        .X_WF = Foothold::Level({0.2, 0.5 * robot.standing_width, 0}),
                        .via_height = 0.25,
                        .duration = 2.0}},
                      0.24, {}, std::make_shared<Lipm>(robot.com_height));
}

}  // namespace halfstep
