#include "wpg/ground/ground.h"

#include <cmath>

#include "wpg/check.h"

namespace halfstep {

double Ground::HeightEverywhere() const {
  const std::optional<GroundLevel> level = OnlyLevel();
  HALFSTEP_CHECK(level.has_value(), Levels().size() << " levels, or borders");
  return level->height;
}

FlatGround::FlatGround(double height) : levels_{{.number = 0, .height = height}} {
  HALFSTEP_CHECK(std::isfinite(height), "height = " << height << " m");
}

std::optional<GroundLevel> FlatGround::LevelUnder(const Eigen::Matrix2Xd&, const Pose2&,
                                                  double below) const {
  return below >= Floor() ? OnlyLevel() : std::nullopt;
}

}  // namespace halfstep
