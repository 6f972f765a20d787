#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "planner/scene/shape.h"
#include "wpg/files/input_file.h"

namespace halfstep {

/// A body in the way. Where it is is a function of time; so far all rest.
struct Obstacle {
  std::string name;                                        ///< unique in its scene.
  Shape shape;                                             ///< in its own frame.
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();  ///< at t = 0
  double speed = 0.0;  ///< none of its points moves faster [m/s]; 0: it rests

  /// X_WO at a time of the walk [s].
  const Eigen::Isometry3d& PoseAt(double /*t*/) const { return X_WO; }
  bool rests() const { return speed == 0.0; }
};

/// What the robot walks among. The floor z = 0 is no obstacle: the floor margin watches it.
struct Scene {
  std::string name;
  std::vector<InputFile> files;  ///< what it was read from: YAML, each reading of a mesh.
  std::vector<Obstacle> obstacles;
  /// Simple polygons on the floor (2×n, counter-clockwise) that no sole may touch [m].
  std::vector<Eigen::Matrix2Xd> no_step;

  /// No point of an obstacle moves faster [m/s].
  double speed() const;
  /// Whether what holds at one time holds at every other.
  bool rests() const { return speed() == 0.0; }
};

/// Reads experiments/scenes/*.yaml (format: planner/README.md, "Scenes"). The name defaults to the
/// file's, without its extension. Throws InputError with every complaint, also about mesh files.
Scene LoadScene(const std::string& yaml_path);
/// The same of the scene file's text.
Scene ParseScene(const std::string& yaml_path, const std::string& text);

}  // namespace halfstep
