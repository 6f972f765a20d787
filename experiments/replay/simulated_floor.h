#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "experiments/replay/seed_draws.h"
#include "experiments/replay/simulated_ground.h"
#include "experiments/tables/trajectory_file.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::replay {

/// What the simulated floor has that the plan does not know of.
struct FloorRelief {
  double plates = 0.0;  ///< the greatest height of plates under the feet [m]; 0: there are none
  double curb = 0.0;    ///< how much higher it is to the right, ahead of the start [m]
  double slope = 0.0;   ///< how steep the floor is [rad]
};

/// Reads "plates=0.01", "curb=-0.01" (metres), "slope=2" (degrees), or several with commas between.
/// Throws InputError, which begins with `who`.
FloorRelief ParseRelief(const std::string& who, const std::string& text);

/// A box in the floor with a level upper face.
struct FloorPlate {
  Eigen::Isometry3d X_FP;  ///< the middle of its upper face, seen from the floor [m]
  Eigen::Vector2d size;    ///< length and width of that face [m]
  bool at_start = false;   ///< whether the robot stands on it at the start; at most one is
};

/// The ground of the scene, turned as a whole, with plates on it.
struct SimulatedFloor {
  /// Of W, in which the walk was planned: z is the normal of what is level there.
  Eigen::Isometry3d X_WFloor = Eigen::Isometry3d::Identity();
  SimulatedGround ground = {};     ///< seen from X_WFloor
  std::vector<FloorPlate> plates;  ///< on the plane z = 0 of X_WFloor
};

/// Draws a floor for the walk of these rows; its ground is left the plane. Each place where a sole
/// lands gets a plate of the sole's size, up to `plates` high and shifted by up to half a sole
/// either way, unless it would be under a sole that stands at the start. A curb is under the right
/// side of the way, a tenth of a sole's length in front of these soles. The plane is turned about
/// the middle of these soles and falls in a drawn direction.
SimulatedFloor DrawFloor(const FloorRelief& relief, const std::vector<TrajectoryRow>& rows,
                         const RobotModel& robot, SeedDraws* draws);

/// The same for a walk of which nothing but its start is known; plates are none.
SimulatedFloor FloorAhead(const FloorRelief& relief, const TrajectoryRow& start,
                          const RobotModel& robot, SeedDraws* draws);

}  // namespace halfstep::replay
