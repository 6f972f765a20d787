#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "planner/ground/level_surface.h"

namespace halfstep {

/// What of a mesh is level (`floor: levels`, planner/README.md).
struct MeshLevels {
  std::vector<LevelSurface> surfaces;  ///< NAME_1, NAME_2 …; empty: nothing of it is level
  std::vector<Eigen::Index> kept;      ///< triangles that are no part of a surface
  int levels = 0;                      ///< how many heights the surfaces have
  double area = 0.0;                   ///< of the triangles that became surfaces [m²]
};

/// Finds the levels of a mesh (3×n vertices in W [m], 3×m triangles, counter-clockwise from
/// outside). Of the triangles that face up and are steeper by at most 10°, the band of heights, as
/// wide as `tolerance` [m], in which those that lie wholly in it have the largest area is a level,
/// then that of the rest, as long as it has 100 cm². A level is as high as its highest point; its
/// triangles become convex surfaces, each a slab down to 1 mm below the band, or to `floor` [m]
/// where that is higher.
MeshLevels LevelsOf(const std::string& name, const Eigen::Matrix3Xd& vertices_W,
                    const Eigen::Matrix3Xi& triangles, double tolerance, double floor);

}  // namespace halfstep
