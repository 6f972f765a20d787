#include "wpg/ground/ground.h"

#include <cmath>

#include "wpg/check.h"

namespace halfstep {

std::optional<Foothold> Ground::Standing(const Eigen::Matrix2Xd& outline, const Pose2& X_WF,
                                         double below) const {
  const std::optional<GroundLevel> level = LevelUnder(outline, X_WF, below);
  return level ? std::optional(Foothold(X_WF, level->height)) : std::nullopt;
}

double Ground::HeightEverywhere() const {
  const std::optional<GroundLevel> level = OnlyLevel();
  HALFSTEP_CHECK(level.has_value(), Levels().size() << " levels, or borders");
  return level->height;
}

void Ground::CheckIsZeroEverywhere() const {
  HALFSTEP_CHECK(HeightEverywhere() == 0.0, "height = " << HeightEverywhere() << " m");
}

FlatGround::FlatGround(double height) : levels_{{.number = 0, .height = height}} {
  HALFSTEP_CHECK(std::isfinite(height), "height = " << height << " m");
}

std::optional<GroundLevel> FlatGround::LevelUnder(const Eigen::Matrix2Xd&, const Pose2&,
                                                  double below) const {
  return below >= Floor() ? OnlyLevel() : std::nullopt;
}

}  // namespace halfstep
