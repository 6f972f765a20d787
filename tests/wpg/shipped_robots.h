#pragma once

#include <array>
#include <string>

#include "tests/places.h"
#include "tests/wpg/hrp2.h"

namespace halfstep {

/// The robots of wpg/robots.
inline const std::array<std::string, 3> kShippedRobots = {"hrp2", "wren", "bison"};

inline RobotModel ShippedRobot(const std::string& name) {
  return LoadRobot(InSources("wpg/robots/") + name + ".yaml");
}

/// Height of the hips when standing, HRP-2's being 1.
inline double LegScale(const RobotModel& robot) {
  static const RobotModel hrp2 = Hrp2();
  const auto height = [](const RobotModel& r) { return r.waist_height + r.legs[0].hip_B.z(); };
  return height(robot) / height(hrp2);
}

}  // namespace halfstep
