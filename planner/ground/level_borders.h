#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "wpg/geometry/bounds_tree.h"
#include "wpg/geometry/pose2.h"
#include "wpg/ground/ground.h"

namespace halfstep {

/// Where the levels of a ground end, prepared for questions about soles that stand. A level is the
/// union of the tops of the solids that bear it, or the whole plane where it is the floor's, less
/// what solids occupy that reach through its height: bottom ≤ height < top. So a surface that rests
/// on another leaves no room below it, and one that lies higher does. Gaps between surfaces of a
/// level that are at most 2 nm wide are none (LevelSurface: places are whole nanometres).
///
/// Const and thread-safe.
class LevelBorders {
 public:
  /// Takes what it needs from `ground`. Ground with one level everywhere has no borders.
  explicit LevelBorders(const Ground& ground);

  bool empty() const { return levels_.empty(); }  ///< whether there is one level everywhere
  /// The level whose height is z [m] but for less than 0.5 nm; −1: there is none.
  int LevelAt(double z) const;

  /// The border of a level that is nearest to a sole.
  struct Nearest {
    /// From the outline to the border [m]: positive where all of the outline lies on the level, and
    /// then exact but for rounding. Else negative: minus how far a corner of the outline is off the
    /// level, or how far a corner of the border lies in the outline, whichever is more; −1e-9 where
    /// they only touch or cross without that; −∞ where the level bears nowhere.
    double distance = std::numeric_limits<double>::infinity();
    /// The solid that ends there or stands in the way, an index into Ground::Solids; −1: none.
    int solid = -1;
  };
  /// How far inside its level a sole stands: `outline` is a convex polygon (2×k) in the sole's
  /// frame [m], at X_WF seen from above. Precondition: a level of the ground.
  Nearest NearestTo(const Eigen::Matrix2Xd& outline, const Pose2& X_WF, int level) const;
  /// The levels that may bear a sole there, the last first: all on which some of it may lie.
  std::vector<int> LevelsNear(const Eigen::Matrix2Xd& outline, const Pose2& X_WF) const;
  /// Whether all of the outline lies on the level and does not touch its border.
  bool Bears(const Eigen::Matrix2Xd& outline, const Pose2& X_WF, int level) const;

 private:
  struct Prism {
    Eigen::Matrix2Xd polygon;
    double top, bottom;
    int bears;  // −1: none
  };
  struct Border {
    Eigen::Matrix2d ends;  // in columns
    int solid;
  };
  struct Level {
    double height;
    bool everywhere;  // but for what is in the way
    std::vector<Border> borders;
    BoundsTree tree;  // of borders
  };

  bool IsInTheWay(const Prism& prism, const Level& level) const;
  std::vector<int> InTheWayOf(const Level& level, const std::vector<int>& bearers) const;
  void AddBorders(int solid, Level* level, bool as_bearer) const;
  bool IsOn(const Level& level, const Eigen::Vector2d& point) const;
  bool AreOn(const Level& level, const Eigen::Matrix2Xd& outline_W) const;
  template <typename Distance>
  Nearest NearestBorder(const Level& level, const Eigen::Vector2d& center, double radius,
                        const Distance& distance) const;

  std::vector<Prism> prisms_;
  BoundsTree tree_;  // of prisms
  std::vector<Level> levels_;
  int floor_level_ = -1;  // the level that bears everywhere but for what is in the way
};

}  // namespace halfstep
