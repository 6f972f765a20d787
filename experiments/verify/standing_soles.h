#pragma once

#include <array>

#include "experiments/verify/played_motion.h"

namespace halfstep::verify {

/// At which heights the soles stand that carry the robot, by Index(Side) [m]; where one stands
/// alone, its height is that of both. What is less than 10⁻¹⁰ m apart, or away from z = 0, is
/// level. Source: wpg/README.md, "Soles at different heights".
struct StandingSoles {
  std::array<double, 2> height;  ///< in W [m]

  /// Of a row's soles.
  explicit StandingSoles(const PlayedRow& row);
  bool level() const { return height[0] == height[1]; }  ///< whether they are the same
};

}  // namespace halfstep::verify
