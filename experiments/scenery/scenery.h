#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planner/scene/shape.h"

namespace halfstep {

/// A plane without end: nothing that a scene can hold, but often its floor.
struct EndlessPlane {
  Eigen::Vector3d normal{0, 0, 1};  ///< unit; it passes through the origin of its frame
};
/// A mesh that no file has which a scene can name: it gets one beside the scene.
struct OwnMesh {
  Eigen::Matrix3Xd vertices;   ///< [m] (3×n)
  Eigen::Matrix3Xi triangles;  ///< (3×m), indices of vertices
};
/// A mesh file that a scene can name: STL, OBJ or DAE.
struct MeshReference {
  std::filesystem::path path;  ///< from the working directory
  /// Metres per unit along its axes; TakeFloorOut makes one an OwnMesh where they differ.
  Eigen::Vector3d scale{1, 1, 1};
};
/// A point cloud or an occupancy map that a scene can name.
struct CloudReference {
  std::filesystem::path path;         ///< from the working directory
  bool is_map = false;                ///< an OctoMap
  double radius = 0.0;                ///< of the balls around points [m]
  std::optional<double> floor_below;  ///< what is not higher is floor [m]
};

/// Something in the way, as another program has it.
struct SceneryThing {
  std::string name;  ///< as it is called there
  std::variant<Box, Sphere, Cylinder, Capsule, EndlessPlane, OwnMesh, MeshReference, CloudReference>
      shape;                                               ///< in its own frame
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();  ///< where it is
  bool brings_floor = false;                               ///< of a mesh: `floor: in_mesh`
};

/// What a file of another program has, before it becomes a scene.
struct Scenery {
  std::vector<SceneryThing> things;  ///< in the order of the file
  std::vector<std::string> told;     ///< what was left out or taken otherwise, a sentence each

  /// Adds a sentence, if it is not there yet.
  void Tell(const std::string& sentence);
};

/// More things are refused.
inline constexpr size_t kMostThings = 100'000;

}  // namespace halfstep
