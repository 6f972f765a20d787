#pragma once

#include <cmath>

namespace halfstep {

/// Linear inverted pendulum: a CoM at constant height z_c over a flat floor, no angular momentum
/// about it. Per horizontal axis c̈ = ω²·(c − p), or p = Z(c) with Z = Id − (z_c/g)·d²/dt².
/// Source: [Kajita2001] eq. 4; [Perrin2011] §III.
struct Lipm {
  double com_height = 0.8;  ///< z_c [m] > 0.
  double gravity = 9.81;    ///< g [m/s²] > 0.

  /// ω = √(g/z_c) [1/s].
  double omega() const { return std::sqrt(gravity / com_height); }
};

}  // namespace halfstep
