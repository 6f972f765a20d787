#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <variant>
#include <vector>

#include "wpg/files/input_file.h"
#include "wpg/geometry/convex_body.h"

namespace halfstep {

/// Triangle mesh: not assumed convex or closed.
struct TriangleMesh {
  Eigen::Matrix3Xd vertices;   ///< [m] (3×n)
  Eigen::Matrix3Xi triangles;  ///< (3×m), vertex indices.
};

/// The faces of a convex body's core, the body without its ball; none when it has fewer than 4
/// vertices.
TriangleMesh FacesOf(const ConvexBody& body);

struct Obstacle {
  std::string name;                              ///< unique in its scene.
  std::variant<ConvexBody, TriangleMesh> shape;  ///< in its own frame.
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
};

/// What the robot walks among. The floor z = 0 is no obstacle: the floor margin watches it.
struct Scene {
  std::string name;
  std::vector<InputFile> files;  ///< what it was read from: YAML, each reading of a mesh.
  std::vector<Obstacle> obstacles;
  /// Simple polygons on the floor (2×n, counter-clockwise) that no sole may touch [m].
  std::vector<Eigen::Matrix2Xd> no_step;
};

/// Reads experiments/scenes/*.yaml (format: planner/README.md, "Scenes"). The name defaults to the
/// file's, without its extension. Throws InputError with every complaint, also about mesh files.
Scene LoadScene(const std::string& yaml_path);
/// The same of the scene file's text.
Scene ParseScene(const std::string& yaml_path, const std::string& text);

}  // namespace halfstep
