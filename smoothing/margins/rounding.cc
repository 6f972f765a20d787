#include "smoothing/margins/rounding.h"

#include <algorithm>
#include <cmath>

#include "wpg/rounded.h"

namespace halfstep {
double SupportRounding(const WalkState& x, const WalkState& off, const Eigen::Vector2d& sole_size,
                       double margin) {
  constexpr double kLeftOut = 1e-9;  // [m] edges of SupportPolygon::Margin
  double corners = 0.0, far = 0.0;
  for (const int foot : {FootIndex(Side::kLeft), FootIndex(Side::kRight)}) {
    corners = std::max(corners, off[foot] + off[foot + 1] + 0.5 * sole_size.norm() * off[foot + 3]);
    far = std::max(far, std::abs(x[foot]) + std::abs(x[foot + 1]));
  }
  return corners + 16.0 * kRoundoff * (far + sole_size.norm()) +
         kLeftOut * kLeftOut / std::max(margin, kLeftOut);
}

double PlanarRounding(double x, double y) {
  constexpr double kAround = 4.0;  // [m] soles and what is near them
  return 32.0 * kRoundoff * (std::abs(x) + std::abs(y) + kAround);
}

double DistanceRounding(const WalkState& x) {
  constexpr double kAround = 8.0;  // [m]
  return 128.0 * kRoundoff *
         (std::abs(x[kComX]) + std::abs(x[kComY]) + std::abs(x[kWaistZ]) + kAround);
}

}  // namespace halfstep
