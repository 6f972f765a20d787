#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "planner/scene/obstacle_motion.h"
#include "planner/scene/shape.h"
#include "wpg/files/input_file.h"
#include "wpg/ground/ground.h"

namespace halfstep {

/// A body in the way, at rest unless its motion says otherwise.
struct Obstacle {
  std::string name;                                        ///< unique in its scene.
  Shape shape;                                             ///< in its own frame.
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();  ///< at t ≤ 0
  ObstacleMotion motion{};                                 ///< from t = 0 on

  /// Where it is said to be at the time t of the walk [s].
  Eigen::Isometry3d PoseAt(double t) const { return motion.PoseAt(X_WO, t); }
  /// How far from there any of its points may be at t [m].
  double UncertaintyAt(double t) const { return motion.UncertaintyAt(t); }
  /// The distance of any fixed point from the obstacle at PoseAt(t), less UncertaintyAt(t), changes
  /// at no more than this speed, at all times [m/s]: the fastest point of the known motion, and
  /// motion.speed.
  double speed() const;
  /// Whether its pose and its uncertainty are the same at all times.
  bool rests() const { return motion.rests(); }
};

/// What the robot walks on and among. The ground is no obstacle, for feet stand on it.
struct Scene {
  std::string name;                 ///< the file's stem, or "none"
  std::vector<InputFile> files;     ///< the YAML file, and one entry for each reading of a mesh.
  std::vector<Obstacle> obstacles;  ///< names differ
  /// Simple polygons (2×n, counter-clockwise) that no sole may touch, seen from above, so on every
  /// level [m].
  std::vector<Eigen::Matrix2Xd> no_step;
  /// Friction coefficient between soles and floor > 0.
  double friction = 0.7;
  /// What of the files was replaced by something larger, left out or is hard to believe, as
  /// "file: …", for the user.
  std::vector<std::string> warnings;
  /// Not null. Flat at z = 0 unless the file has surfaces (planner/README.md, "Levels").
  std::shared_ptr<const Ground> ground = std::make_shared<const FlatGround>();

  /// The obstacle of an index that counts the obstacles first and then the solids of the ground;
  /// null: it is a solid, which rests.
  const Obstacle* ObstacleAt(int index) const;
  /// The name of the obstacle or of the ground's solid of such an index.
  const std::string& NameOf(int index) const;

  /// Its ground and friction under its name: no obstacles, no areas, nothing of files.
  Scene Emptied() const;
  /// Whether all obstacles rest, so that what holds at one time holds at every time.
  bool rests() const;
  /// Whether from time `since` [s] on no obstacle is nearer at an earlier time than at a later one:
  /// there are no waypoints, and uncertainty only grows. So a motion that is clear stays clear when
  /// it is made earlier, but not before `since`.
  bool OnlyGrowsFrom(double since) const;
};

/// Reads a scene file, such as experiments/scenes/*.yaml (format: planner/README.md, "Scenes"). The
/// scene's name defaults to the file's name without extension. Throws InputError with every
/// complaint, also those about mesh files.
Scene LoadScene(const std::string& yaml_path);
/// The same for the text of a scene file. `yaml_path` stands for it in complaints, and paths of
/// mesh files are relative to its folder.
Scene ParseScene(const std::string& yaml_path, const std::string& text);

}  // namespace halfstep
