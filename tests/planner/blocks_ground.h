#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "wpg/geometry/simple_polygon.h"
#include "wpg/ground/ground.h"

namespace halfstep {

/// A block of ground, along the axes unless its polygon is changed.
inline GroundSolid Block(const std::string& name, double x_min, double x_max, double y_min,
                         double y_max, double top, double bottom = -1.0) {
  GroundSolid block{.name = name, .polygon = {}, .top = top, .bottom = bottom, .bears = {}};
  block.polygon.resize(2, 4);
  block.polygon << x_min, x_max, x_max, x_min, y_min, y_min, y_max, y_max;
  return block;
}

/// Blocks that stand on a floor, or on nothing: the tops are levels, equal where their heights are.
class BlocksGround final : public Ground {
 public:
  static constexpr double kNoFloor = -std::numeric_limits<double>::infinity();

  BlocksGround(double floor, std::vector<GroundSolid> blocks)
      : floor_(floor), solids_(std::move(blocks)) {
    if (std::isfinite(floor)) levels_.push_back({.number = 0, .height = floor});
    for (GroundSolid& block : solids_) {
      const auto same = std::ranges::find(levels_, block.top, &GroundLevel::height);
      block.bears = static_cast<int>(same - levels_.begin());
      if (same == levels_.end()) levels_.push_back({.number = *block.bears, .height = block.top});
    }
  }

  double Floor() const override { return floor_; }
  const std::vector<GroundSolid>& Solids() const override { return solids_; }
  const std::vector<GroundLevel>& Levels() const override { return levels_; }
  std::optional<GroundLevel> LevelUnder(const Eigen::Matrix2Xd& outline, const Pose2& X_WF,
                                        double below) const override {
    const Eigen::Matrix2Xd sole = (X_WF.rotation() * outline).colwise() + X_WF.position();
    std::optional<GroundLevel> highest;
    bool touches = false;
    for (const GroundSolid& block : solids_) {
      if (PolygonsTouch(sole, block.polygon) && block.bottom <= floor_) touches = true;
      if (block.top > below) continue;
      const GroundLevel& level = levels_[static_cast<size_t>(*block.bears)];
      if (!Holds(block.polygon, sole) || (highest && highest->height >= level.height)) continue;
      highest = level;
    }
    if (!highest && !touches && std::isfinite(floor_) && floor_ <= below) highest = levels_[0];
    return highest;
  }
  std::optional<GroundLevel> OnlyLevel() const override {
    return solids_.empty() ? std::optional(levels_[0]) : std::nullopt;
  }

 private:
  static bool Holds(const Eigen::Matrix2Xd& polygon, const Eigen::Matrix2Xd& sole) {
    for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
      const Eigen::Vector2d a = polygon.col(i), b = polygon.col((i + 1) % polygon.cols());
      for (const Eigen::Vector2d& p : sole.colwise()) {
        if ((b - a).x() * (p - a).y() - (b - a).y() * (p - a).x() < 0.0) return false;
      }
    }
    return true;
  }

  double floor_;
  std::vector<GroundSolid> solids_;
  std::vector<GroundLevel> levels_;
};

}  // namespace halfstep
