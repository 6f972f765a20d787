#pragma once

#include <array>
#include <stop_token>
#include <utility>
#include <vector>

#include "planner/ground/level_borders.h"
#include "planner/scene/no_step_areas.h"
#include "planner/scene/scene.h"
#include "smoothing/margins/body_clearances.h"
#include "smoothing/margins/body_heights.h"
#include "smoothing/margins/foot_solids.h"
#include "smoothing/margins/work.h"
#include "wpg/geometry/foothold.h"
#include "wpg/geometry/pose2.h"
#include "wpg/robot/robot_model.h"
#include "wpg/workers.h"

namespace halfstep {

/// A robot among the obstacles of a scene, prepared for the questions of all families. It cannot be
/// moved, because its parts borrow from each other.
struct MarginPlace {
  /// Prepares both; takes as long as building the scene's trees.
  MarginPlace(RobotModel r, Scene s, OwnMargins its_own)
      : robot(std::move(r)),
        scene(std::move(s)),
        own(std::move(its_own)),
        clearances(robot, scene),
        heights(robot, scene.ground->Floor()),
        areas(scene, robot.sole_outline),
        solids(robot, scene),
        levels(*scene.ground) {}
  MarginPlace(const MarginPlace&) = delete;
  MarginPlace& operator=(const MarginPlace&) = delete;

  RobotModel robot;           ///< the robot that walks
  Scene scene;                ///< where it walks
  OwnMargins own;             ///< the statements of the family `own`
  BodyClearances clearances;  ///< of the robot's bodies in the scene
  BodyHeights heights;        ///< of the robot's bodies above the floor
  NoStepAreas areas;          ///< of the scene, for the robot's soles
  FootSolids solids;          ///< of the scene's ground, for the robot's feet
  LevelBorders levels;        ///< of the scene's ground
};

/// What families remember from one instant to the next, and the work that was done. Use
/// one for each thread.
struct MarginScratch {
  /// The no-step area that was nearest to a sole where it stood last.
  struct Standing {
    Pose2 X_WF;                    ///< where the sole stood, seen from above
    NoStepAreas::Nearest nearest;  ///< the area nearest to it there
    bool known = false;            ///< whether it has stood
  };
  /// The border of its level that was nearest to a sole where it stood last.
  struct OnLevel {
    Foothold X_WF;                  ///< where the sole stood
    LevelBorders::Nearest nearest;  ///< the border nearest to it there
    bool known = false;             ///< whether it has stood
  };
  BodyClearances::Scratch bodies;         ///< of BodyClearances
  Work work = {};                         ///< done so far
  std::stop_token stop = {};              ///< ends proofs; what is not decided then stays undecided
  std::array<Standing, 2> standing = {};  ///< by Index(Side)
  std::array<OnLevel, 2> on_level = {};   ///< by Index(Side)
  /// Threads that proofs may use beside the caller's, borrowed; null: none.
  Workers* workers = nullptr;
  std::vector<MarginScratch> of_others = {};  ///< of those threads, made when they are first used
};

}  // namespace halfstep
