#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "experiments/control/controllers.h"
#include "experiments/replay/disturbance.h"
#include "experiments/replay/replay.h"
#include "experiments/replay/simulated_floor.h"
#include "experiments/replay/simulated_obstacles.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep::replay {

/// What moves the robot in place of the plan itself.
struct ControlSetup {
  control::MakeController make;    ///< the controller
  control::SensorOptions sensors;  ///< what it measures by
};

/// The robot, place and way in which walks are played.
struct ReplaySetup {
  WholeRobot robot;                          ///< with all links
  std::vector<SimulatedObstacle> obstacles;  ///< among which it walks
  SimulatedGround ground;                    ///< on which it walks, but for the relief
  ModelOptions model;                        ///< undisturbed
  FloorRelief relief;                        ///< of the floor, which seeds draw
  PlayOptions play;                     ///< how it is played, but for its `control` and `gauge`
  std::optional<ControlSetup> control;  ///< none: the servos get the plan itself
  bool measures_tube = false;           ///< whether PlayOptions::gauge is set

  /// Whether there is something that bodies of the robot may touch.
  bool has_touchable() const { return !obstacles.empty() || !ground.solids.empty(); }
  /// The simulated robot, undisturbed. `floor` of ModelOptions is replaced.
  Simulation Robot(const SimulatedFloor& floor) const;
  /// Disturbed.
  Simulation Robot(const SimulatedFloor& floor, const Disturbance& drawn) const;
  /// What a controller, or who watches for pushes, may know of it: the undisturbed model, which is
  /// borrowed.
  control::ControlledRobot Controlled() const;
  /// How a motion is played on one of them, controlled. What is drawn no controller knows.
  PlayOptions PlayOf(const Simulation& simulated, const ReferenceMotion& motion) const;
};

/// What a seed draws for a walk.
struct SeedWorld {
  Disturbance disturbance;  ///< drawn first
  SimulatedFloor floor;     ///< drawn then
};
/// What seed k draws is the same whichever other seeds are played.
SeedWorld DrawWorld(int seed, const ReplaySetup& setup, const ReferenceMotion& motion);

/// A walk in the world of one seed.
struct SeedReplay {
  int seed = 1;          ///< from 1
  std::string unstable;  ///< why MuJoCo gave up, which counts as a fall; "": it did not
  Disturbance drawn;     ///< by it
  ReplayResult result;   ///< without rows, and without the mass model's ZMP
};

/// Plays a walk in the worlds of the seeds 1 … `seeds`; those that were played when stopped.
std::vector<SeedReplay> PlaySeeds(const ReplaySetup& setup, const ReferenceMotion& motion,
                                  int seeds, const std::function<void(double done)>& progress,
                                  std::stop_token stop);

/// How many stayed up.
int Standing(const std::vector<SeedReplay>& all);
/// The median of a number of the results; of an even number the mean of the middle two.
/// Precondition: there is at least one.
double MedianOf(const std::vector<SeedReplay>& all, double ReplayResult::*number);
/// The largest of a number of the results.
double LargestOf(const std::vector<SeedReplay>& all, double ReplayResult::*number);

}  // namespace halfstep::replay
