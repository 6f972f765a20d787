#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/live/true_world.h"
#include "experiments/replay/simulated_ground.h"
#include "planner/scene/scene.h"
#include "wpg/geometry/convex_body.h"

namespace halfstep::replay {

/// A body in the simulated robot's way. Nothing that the robot does moves it.
struct SimulatedObstacle {
  std::string name;  ///< as in its scene
  ConvexBody body;   ///< in its own frame; a mesh is its convex hull
  /// Its pose in W at the time t of the walk [s]; none: it is not there.
  std::function<std::optional<Eigen::Isometry3d>(double t)> pose;
};

/// Obstacles and ground as MuJoCo takes them, and in words what it takes otherwise than the scene
/// says.
struct SimulatedObstacles {
  std::vector<SimulatedObstacle> obstacles;  ///< in the order of the scene
  /// One sentence for each mesh: it stands for its convex hull, or is left out since it is flat.
  std::vector<std::string> notes;
  SimulatedGround ground = {};  ///< what it stands on
};

/// The obstacles of a scene, which move as the scene says, and its ground. Precondition: its floor,
/// if it has one, is at z = 0 (std::logic_error).
SimulatedObstacles ObstaclesOf(const Scene& scene);
/// The obstacles of an episode, which move and are there as the script says, not as was measured,
/// and its ground. Precondition: the same.
SimulatedObstacles ObstaclesOf(const TrueWorld& truth);

}  // namespace halfstep::replay
