#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "planner/search/step_graph.h"

namespace halfstep {

/// A lattice that tells states apart: two states in one cell count as the same, though each keeps
/// its exact pose; those at different heights, of soles or waist, do not. Smaller cells: more
/// states to search; larger ones: narrow ways are missed.
struct PoseCells {
  double position = 0.02;  ///< edge [m] > 0
  double yaw = 0.05;       ///< edge [rad] > 0, modulo 2π

  /// One number a cell, for |x|, |y| < 2²⁰ cells; at other heights than 0, numbers that are not the
  /// same but by an accident, with chances of 2⁻⁶⁴.
  std::uint64_t KeyOf(const StepState& state) const {
    const auto cell = [](double value, double edge, int bits) {
      const auto index = static_cast<std::int64_t>(std::floor(value / edge + 0.5));
      return static_cast<std::uint64_t>(index) & ((std::uint64_t{1} << bits) - 1);
    };
    double turned = state.X_WS.yaw;
    // Within half a turn the remainder is the yaw itself.
    if (!(std::fabs(turned) <= std::numbers::pi)) {
      turned = std::remainder(turned, 2.0 * std::numbers::pi);
    }
    const std::uint64_t planar =
        cell(state.X_WS.x, position, 21) << 43 | cell(state.X_WS.y, position, 21) << 22 |
        cell(turned, yaw, 21) << 1 | static_cast<std::uint64_t>(Index(state.support));
    // Of 0 it is 0.
    std::uint64_t height = std::bit_cast<std::uint64_t>(state.X_WS.height + 0.0);
    height = (height ^ height >> 32) * 0x9e3779b97f4a7c15u;
    return planar ^ height ^ static_cast<std::uint64_t>(state.form) * 0xd1b54a32d192ed03u;
  }
};

}  // namespace halfstep
