#pragma once

#include <optional>
#include <vector>

#include "planner/ground/level_borders.h"
#include "planner/ground/level_surface.h"
#include "wpg/ground/ground.h"

namespace halfstep {

/// Level surfaces over a floor at z = 0, or over nothing. Heights and corners are taken in whole
/// nanometres; surfaces of one height are one level, and where they touch a sole may stand on
/// several. Levels are numbered by height, the lowest first; solids are as the surfaces.
class LevelGround final : public Ground {
 public:
  /// `has_floor`: z = 0 bears wherever no surface's solid stands on it. Preconditions
  /// (std::logic_error): at least one surface; each is convex (WhyNotConvex), and its bottom below
  /// its height and not below the floor.
  LevelGround(const std::vector<LevelSurface>& surfaces, bool has_floor);

  double Floor() const override { return floor_; }
  const std::vector<GroundSolid>& Solids() const override { return solids_; }
  const std::vector<GroundLevel>& Levels() const override { return levels_; }
  /// As Ground says; an outline that touches the border of a level is not borne by it.
  std::optional<GroundLevel> LevelUnder(const Eigen::Matrix2Xd& outline, const Pose2& X_WF,
                                        double below) const override;
  /// None: there are borders.
  std::optional<GroundLevel> OnlyLevel() const override { return std::nullopt; }

 private:
  double floor_;
  std::vector<GroundSolid> solids_;
  std::vector<GroundLevel> levels_;
  std::optional<LevelBorders> borders_;  // made last, of what is above
};

/// The level of a name: that of the surface of this name, or of the floor for "floor"; none where
/// there is none, or nothing may stand there.
std::optional<GroundLevel> LevelNamed(const Ground& ground, const std::string& name);

}  // namespace halfstep
