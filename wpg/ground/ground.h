#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "wpg/geometry/foothold.h"
#include "wpg/geometry/pose2.h"

namespace halfstep {

/// A level of the ground: soles on one stand at one height. Two levels are the same when their
/// numbers are, not when their heights happen to be equal.
struct GroundLevel {
  int number = 0;       ///< index into Ground::Levels
  double height = 0.0;  ///< in W [m]
  friend bool operator==(const GroundLevel&, const GroundLevel&) = default;
};

/// What bears a level above the floor: the upright prism below it. No body may enter it; a foot may
/// stand on its top.
struct GroundSolid {
  std::string name;          ///< in the scene's words
  Eigen::Matrix2Xd polygon;  ///< seen from above, in W: convex, counter-clockwise (2×n) [m]
  double top = 0.0;          ///< z of its upper side [m]
  double bottom = 0.0;       ///< z of its lower side [m]
  std::optional<int> bears;  ///< the level that its top belongs to; none: nothing may stand there
};

/// What a robot walks on: level surfaces at heights, and the solids that bear them. It rests, and
/// is the same for all t. Whoever means the ground asks it, once where something is prepared or
/// once a sole, never once a body: what an instant needs is kept by who asks.
///
/// Const and thread-safe.
class Ground {
 public:
  Ground() = default;
  Ground(const Ground&) = delete;
  Ground& operator=(const Ground&) = delete;
  virtual ~Ground() = default;

  /// Height of the floor, below which all is solid [m]; −∞: there is none, only Solids().
  virtual double Floor() const = 0;
  /// What stands out of the floor, in no order. Empty on flat ground.
  virtual const std::vector<GroundSolid>& Solids() const = 0;
  /// All levels, by number.
  virtual const std::vector<GroundLevel>& Levels() const = 0;

  /// The level on which all of a sole stands: `outline` (2×k) is what touches the ground under it,
  /// a convex polygon in the sole's frame [m], and X_WF the sole's place seen from above. None
  /// where part of it lies on nothing, or on another level. Of levels above each other: the highest
  /// that is not above `below` [m], which may be +∞.
  virtual std::optional<GroundLevel> LevelUnder(const Eigen::Matrix2Xd& outline, const Pose2& X_WF,
                                                double below) const = 0;

  /// The one level that bears everywhere, so that whoever stands has its height and need not ask
  /// where; none where there are borders or more levels than one.
  virtual std::optional<GroundLevel> OnlyLevel() const = 0;

  /// The place in W of a sole that stands at X_WF, seen from above: on the level under it, as
  /// LevelUnder finds it; none where that finds none.
  std::optional<Foothold> Standing(const Eigen::Matrix2Xd& outline, const Pose2& X_WF,
                                   double below = std::numeric_limits<double>::infinity()) const;

  /// The height of the only level [m], for what knows one only. Precondition: there is one
  /// (std::logic_error).
  double HeightEverywhere() const;
  /// Precondition of what knows the plane z = 0 alone: that is the only level (std::logic_error).
  void CheckIsZeroEverywhere() const;
};

/// One level everywhere.
class FlatGround final : public Ground {
 public:
  /// At `height` in W [m]. Precondition: finite (std::logic_error).
  explicit FlatGround(double height = 0.0);

  double Floor() const override { return levels_.front().height; }
  const std::vector<GroundSolid>& Solids() const override { return solids_; }
  const std::vector<GroundLevel>& Levels() const override { return levels_; }
  std::optional<GroundLevel> LevelUnder(const Eigen::Matrix2Xd& outline, const Pose2& X_WF,
                                        double below) const override;
  std::optional<GroundLevel> OnlyLevel() const override { return levels_.front(); }

 private:
  std::vector<GroundLevel> levels_;
  std::vector<GroundSolid> solids_;
};

}  // namespace halfstep
