#include "experiments/verify/standing_soles.h"

#include <cmath>

namespace halfstep::verify {
namespace {

constexpr double kLevel = 1e-10;  // heights closer than this are the same [m]

}  // namespace

StandingSoles::StandingSoles(const PlayedRow& row) {
  for (size_t side = 0; side < 2; ++side) {
    const size_t of = row.support == Support::kBoth ? side : static_cast<size_t>(row.support);
    const double z = row.soles[of][2];
    height[side] = std::abs(z) < kLevel ? 0.0 : z;
  }
  if (std::abs(height[1] - height[0]) < kLevel) height[1] = height[0];
}

}  // namespace halfstep::verify
