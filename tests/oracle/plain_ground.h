#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "experiments/verify/min_norm_point.h"
#include "tests/oracle/plain_soles.h"

namespace halfstep::oracle {

/// A surface as a scene file says it (planner/README.md, "Levels"): a polygon, or a flight of
/// stairs.
struct PlainSurface {
  std::string name;
  Polygon polygon = {};   ///< convex, in W [m]; empty: a flight
  double height = 0;      ///< [m]
  double thickness = -1;  ///< of its solid [m]; below 0: down to the floor
  /// Of a flight: treads, and the middle of the foot of the first riser.
  int count = 0;
  double rise = 0, run = 0, width = 0;  ///< [m]
  Eigen::Vector3d at{0, 0, 0};          ///< [m]
  double yaw_deg = 0;                   ///< up along its x
};

/// An upright prism whose top bears.
struct PlainSolid {
  std::string name;
  Polygon outline;             ///< convex [m]
  double bottom = 0, top = 0;  ///< [m]
  verify::ConvexSet set;       ///< the same
  Eigen::Vector3d center{0, 0, 0};
  double radius = 0;  ///< of a ball around the center that holds it [m]
};

/// What a robot walks on, with heights and corners in whole nanometres.
class PlainGround {
 public:
  PlainGround() = default;
  PlainGround(bool has_floor, const std::vector<PlainSurface>& surfaces);

  bool has_floor() const { return has_floor_; }
  bool has_levels() const { return !has_floor_ || !solids_.empty(); }
  const std::vector<PlainSolid>& solids() const { return solids_; }
  /// Height of the highest top that bears a point, or of the floor.
  std::optional<double> HeightUnder(const Eigen::Vector2d& p) const;

  /// How far the convex outline, the hull of points, is from what is not the level of that height:
  /// where the level ends and where something stands on it [m]. −1 µm where it reaches there, −∞
  /// where there is no such level.
  double Inside(const Polygon& outline, double height) const;

 private:
  // Whether the level of that height bears a point, and no solid is there.
  bool Bears(const Eigen::Vector2d& p, double height) const;

  bool has_floor_ = true;
  std::vector<PlainSolid> solids_;
};

}  // namespace halfstep::oracle
