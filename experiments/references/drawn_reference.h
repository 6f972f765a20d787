#pragma once

#include <optional>
#include <random>
#include <string>

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// A reference motion as it is drawn: a walk on an empty floor, or standing. Whether the robot can
/// do it is for others to say.
struct DrawnReference {
  /// standing, stepping, forward, backward, sideways, turning, arc or diagonal.
  std::string kind;
  std::string config;  ///< YAML text of the walk's config
  /// Standing: for how long [s]. The walk is then a step on the spot, whose first instant it is.
  std::optional<double> stands;
};

/// How the config of a drawn reference names things.
struct ReferenceNames {
  std::string name;    ///< of the reference
  std::string robot;   ///< the robot's name or file
  std::string method;  ///< of smoothing
};

/// Draws reference `number`, from 1, of a set: of the kinds in their order, over and over; 4 to 20
/// footsteps (few as often as many) at an even pace; how far they lead ahead, aside and around; a
/// duration of the half-steps of 0.9 to 2.4 s, and how high the swing foot goes, 0.75 to 1 of the
/// default. Lengths are those of HRP-2 scaled by the leg's, durations by the square root of that,
/// all rounded to what is written. Of standing, the places of the soles and a time of 2 to 10 s.
/// The same robot and random numbers give the same bytes.
DrawnReference DrawReference(const ReferenceNames& names, int number, const RobotModel& robot,
                             std::mt19937_64& random);

}  // namespace halfstep
