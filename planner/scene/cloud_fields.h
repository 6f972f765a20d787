#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "planner/scene/shape.h"
#include "wpg/files/fields.h"
#include "wpg/files/octomap_file.h"
#include "wpg/files/point_file.h"

namespace halfstep {

/// What a scene says under `points` or `octomap` (planner/README.md, "Scenes"): obstacles that are
/// cubes of a lattice in the obstacle's frame.
struct CloudFields {
  std::optional<LoadedPoints> points;  ///< none: there is no `points`
  double radius = 0.0;                 ///< of the ball around each point [m]
  std::optional<LoadedOctomap> map;    ///< none: there is no `octomap`
  bool unknown_is_occupied = false;    ///< whether cells of which nothing is known are obstacles
  std::optional<double> floor_below;   ///< what is not higher above the floor is floor [m]
  std::vector<std::string> told;       ///< for the user: what was left out

  bool any() const { return points || map; }  ///< whether either is there
  InputFile file;                             ///< what was read
};

/// Declares the keys and reads the file, relative to the scene's folder.
void DeclarePoints(Fields& fields, CloudFields* cloud);
/// The same for `octomap`.
void DeclareOctomap(Fields& fields, CloudFields* cloud);

/// The surface of a cloud at X_WO. Every ball around a point, or every cube that is occupied, is
/// inside it, but for what is floor, by the floor's height `floor` in W [m]. `obstacle` is the
/// group around the cloud, for complaints; with one the mesh is empty.
TriangleMesh MeshOfCloud(Fields& obstacle, const Eigen::Isometry3d& X_WO, double floor,
                         CloudFields* cloud);

}  // namespace halfstep
