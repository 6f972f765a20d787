#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "planner/scene/mesh_floor.h"
#include "planner/scene/shape.h"
#include "wpg/files/fields.h"
#include "wpg/files/input_file.h"

namespace halfstep {

/// What a scene says under `mesh` (planner/README.md, "Scenes").
struct MeshFields {
  TriangleMesh mesh;               ///< scaled [m]; without triangles when it could not be read
  InputFile file;                  ///< what was read
  std::optional<ConvexBody> hull;  ///< in place of the mesh
  bool brings_floor = false;       ///< `floor: in_mesh`: its floor is no obstacle
  double floor_tolerance = kFloorTolerance;  ///< [m]
  std::vector<std::string> told;             ///< for the user: of axes, hull and floor
};

/// Declares the keys of a mesh and reads its file, relative to the scene's folder.
void DeclareMesh(Fields& fields, MeshFields* mesh);

/// Takes the floor, at z = `floor` [m], out of a mesh at X_WO that brings it along. `obstacle` is
/// the group around `mesh`, for complaints.
void TakeFloor(Fields& obstacle, const Eigen::Isometry3d& X_WO, double floor, bool rests,
               MeshFields* mesh);

}  // namespace halfstep
