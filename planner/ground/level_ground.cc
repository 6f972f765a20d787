#include "planner/ground/level_ground.h"

#include <algorithm>
#include <limits>
#include <set>

#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {

LevelGround::LevelGround(const std::vector<LevelSurface>& surfaces, bool has_floor)
    : floor_(has_floor ? 0.0 : -std::numeric_limits<double>::infinity()) {
  HALFSTEP_CHECK(!surfaces.empty(), "no surface");
  std::set<double> heights;
  if (has_floor) heights.insert(0.0);
  for (const LevelSurface& surface : surfaces) {
    const double top = WholeNanometres(surface.height), bottom = WholeNanometres(surface.bottom);
    const Eigen::Matrix2Xd corners = CornersOf(surface.polygon);
    HALFSTEP_CHECK(WhyNotConvex(corners).empty(), surface.name << ": " << WhyNotConvex(corners));
    HALFSTEP_CHECK(bottom < top && bottom >= floor_,
                   surface.name << ": from " << bottom << " to " << top << " m");
    solids_.push_back({surface.name, corners, top, bottom, std::nullopt});
    if (surface.bears) heights.insert(top);
  }
  for (const double height : heights) {
    levels_.push_back({static_cast<int>(levels_.size()), height});
  }
  for (size_t i = 0; i < surfaces.size(); ++i) {
    if (!surfaces[i].bears) continue;
    const auto at = heights.find(solids_[i].top);
    solids_[i].bears = static_cast<int>(std::distance(heights.begin(), at));
  }
  borders_.emplace(*this);
}

std::optional<GroundLevel> LevelGround::LevelUnder(const Eigen::Matrix2Xd& outline,
                                                   const Pose2& X_WF, double below) const {
  // By number, so by height.
  for (const int number : borders_->LevelsNear(outline, X_WF)) {
    const GroundLevel& level = Nth(levels_, number);
    if (level.height <= below && borders_->Bears(outline, X_WF, number)) return level;
  }
  return std::nullopt;
}

std::optional<GroundLevel> LevelNamed(const Ground& ground, const std::string& name) {
  const auto of_floor = std::ranges::find(ground.Levels(), ground.Floor(), &GroundLevel::height);
  if (name == "floor" && of_floor != ground.Levels().end()) return *of_floor;
  for (const GroundSolid& solid : ground.Solids()) {
    if (solid.name == name && solid.bears) return Nth(ground.Levels(), *solid.bears);
  }
  return std::nullopt;
}

}  // namespace halfstep
