#include "wpg/ground/ground.h"

#include <cmath>

#include "wpg/check.h"

namespace halfstep {

FlatGround::FlatGround(double height) : levels_{{.number = 0, .height = height}} {
  HALFSTEP_CHECK(std::isfinite(height), "height = " << height << " m");
}

std::optional<GroundLevel> FlatGround::LevelUnder(const Eigen::Matrix2Xd&, const Pose2&,
                                                  double below) const {
  return below >= Floor() ? OnlyLevel() : std::nullopt;
}

}  // namespace halfstep
