#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "experiments/verify/min_norm_point.h"
#include "tests/oracle/plain_ground.h"

namespace halfstep::oracle {

// Shared with `halfstep verify`, the other second implementation.
using verify::Bracket;
using verify::ConvexSet;
using verify::DistanceOf;

/// An obstacle as a scene file says it (planner/README.md, "Scenes").
struct PlainObstacle {
  enum class Kind { kBox, kCylinder, kSphere, kCapsule, kMesh, kPoints };
  std::string name;
  Kind kind = Kind::kBox;
  Eigen::Vector3d size{0, 0, 0};          ///< box: edges; others: radius, length [m]
  std::vector<Eigen::Vector3d> vertices;  ///< mesh, in the file's unit; points of a cloud [m]
  std::vector<std::array<int, 3>> triangles;
  double scale = 1;  ///< [m per unit]
  Eigen::Vector3d xyz{0, 0, 0}, rpy_deg{0, 0, 0};
  /// planner/README.md, "Obstacles that move": known motion, and how well it is known.
  struct Waypoint {
    double t = 0;  ///< [s]
    Eigen::Vector3d xyz{0, 0, 0};
    double yaw_deg = 0;
  };
  std::vector<Waypoint> waypoints = {};
  double error = 0, speed = 0, measured_at = 0;  ///< [m], [m/s], [s]
  double horizon = -1;                           ///< [s]; below 0: none
  bool has_motion() const { return !waypoints.empty() || error > 0 || speed > 0; }
};

struct PlainScene {
  std::vector<PlainObstacle> obstacles;
  std::vector<std::vector<Eigen::Vector2d>> no_step;  ///< polygons on the floor, in W [m]
  double friction = 0.7;
  bool has_floor = true;  ///< z = 0 bears
  std::vector<PlainSurface> surfaces;
  bool has_levels() const { return !has_floor || !surfaces.empty(); }
};

/// Writes scene.yaml and the meshes into a folder that exists; returns the path of scene.yaml.
std::string WriteScene(const PlainScene& scene, const std::string& folder);

/// What stands near a walk, in W: obstacles as convex pieces, where they are at the start. A point
/// that meets an obstacle at t is asked for AtStart. The ground is no obstacle. Meshes as their own
/// triangles, cut in quadruple precision to a box of some metres, so that far corners cost no
/// digits.
class PlacedScene {
 public:
  /// `center` of the box [m].
  PlacedScene(const PlainScene& scene, const Eigen::Vector3d& center);

  const PlainGround& ground() const { return ground_; }
  size_t size() const { return obstacles_.size(); }
  const std::string& name(size_t obstacle) const { return obstacles_[obstacle].name; }
  /// Moves a point of W with the obstacle, from where this is at t [s] to where it is at the start.
  Eigen::Vector3d AtStart(size_t obstacle, double t, const Eigen::Vector3d& point) const;
  /// How far any point of the obstacle may be from where it is said to be at t [m].
  double Uncertainty(size_t obstacle, double t) const;
  /// No point of the obstacle is faster, what is uncertain included [m/s].
  double speed(size_t obstacle) const;
  /// Distance of a convex set, with a ball around `center` that holds it, from the surface (mesh)
  /// or the solid (else). More than `enough` is not told apart [m].
  Bracket Distance(size_t obstacle, const ConvexSet& set, const Eigen::Vector3d& center,
                   double radius, double enough) const;

  /// The same from the balls around the pieces and the body's: at most the distance, maybe < 0 [m].
  double BallDistance(size_t obstacle, const Eigen::Vector3d& center, double radius) const;

  /// Whether a point lies in the bounds of a mesh. False for what is no mesh.
  bool MightSurround(size_t obstacle, const Eigen::Vector3d& point) const;

  /// How a mesh surrounds a point that is not on it.
  struct Inside {
    double component = 0;     ///< largest |winding number| of one connected part
    double sum = 0;           ///< |winding number| of all
    bool surrounded = false;  ///< a ray in each of 14 directions meets a triangle
    /// In the body of a closed solid, whichever way its triangles turn.
    bool surely() const { return component > 0.9; }
    bool maybe() const { return component > 0.3 || sum > 0.3 || surrounded; }
  };
  /// Nothing for what is no mesh.
  Inside Around(size_t obstacle, const Eigen::Vector3d& point) const;

 private:
  struct Piece {
    ConvexSet set;
    Eigen::Vector3d center{0, 0, 0};
    double radius = 0;
  };
  using Triangle = std::array<Eigen::Vector3d, 3>;
  struct Placed {
    std::string name;
    PlainObstacle motion;  // without its shape
    double radius = 0;     // of its points about the origin of its frame [m]
    std::vector<Piece> pieces;
    std::vector<std::vector<Triangle>> components;  // in W, relative to the scene's center
    Eigen::AlignedBox3d bounds;                     // of these
  };
  void AddMesh(const PlainObstacle& obstacle, Placed* placed) const;
  void AddCloud(const PlainObstacle& obstacle, Placed* placed) const;

  Eigen::Vector3d center_;
  std::vector<Placed> obstacles_;
  PlainGround ground_;
};

}  // namespace halfstep::oracle
