#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "planner/ground/level_surface.h"
#include "planner/scene/mesh_floor.h"
#include "planner/scene/shape.h"
#include "wpg/files/fields.h"
#include "wpg/files/input_file.h"

namespace halfstep {

/// What a scene says under `mesh` (planner/README.md, "Scenes").
struct MeshFields {
  TriangleMesh mesh;                   ///< scaled [m]; without triangles when it could not be read
  InputFile file;                      ///< what was read
  std::optional<ConvexBody> hull;      ///< in place of the mesh
  bool brings_floor = false;           ///< `floor: in_mesh` or `levels`: its floor is no obstacle
  bool has_levels = false;             ///< `floor: levels`: nor is what of it is level
  std::vector<LevelSurface> surfaces;  ///< these levels, named after the obstacle
  double floor_tolerance = kFloorTolerance;  ///< [m]
  std::vector<std::string> told;             ///< for the user: of axes, hull and floor
};

/// Declares the keys of a mesh and reads its file, relative to the scene's folder.
void DeclareMesh(Fields& fields, MeshFields* mesh);

/// Takes the floor, at z = `floor` [m] (−∞: there is none), and the levels out of a mesh at X_WO
/// that brings them along; nothing may be left. `obstacle` is the group around `mesh`, for
/// complaints, and `name` its name.
void TakeFloor(Fields& obstacle, const std::string& name, const Eigen::Isometry3d& X_WO,
               double floor, bool rests, MeshFields* mesh);

}  // namespace halfstep
