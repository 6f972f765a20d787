#pragma once

#include <array>
#include <stop_token>
#include <utility>

#include "halfstep/planner/scene/no_step_areas.h"
#include "halfstep/planner/scene/scene.h"
#include "halfstep/smoothing/margins/body_clearances.h"
#include "halfstep/smoothing/margins/body_heights.h"
#include "halfstep/wpg/geometry/footprint.h"
#include "halfstep/wpg/robot/robot_model.h"

namespace halfstep {

/// A robot among the obstacles of a scene, prepared for the questions of all families. It cannot be
/// moved, because its parts borrow from each other.
struct MarginPlace {
  MarginPlace(RobotModel r, Scene s)
      : robot(std::move(r)),
        scene(std::move(s)),
        clearances(robot, scene),
        heights(robot),
        areas(scene, robot.sole_outline) {}
  MarginPlace(const MarginPlace&) = delete;
  MarginPlace& operator=(const MarginPlace&) = delete;

  RobotModel robot;
  Scene scene;
  BodyClearances clearances;
  BodyHeights heights;
  NoStepAreas areas;
};

/// What families remember from one instant to the next, and how many instants were asked about. Use
/// one for each thread.
struct MarginScratch {
  /// The no-step area that was nearest to a sole where it stood last.
  struct Standing {
    Footprint X_WF;
    NoStepAreas::Nearest nearest;
    bool known = false;
  };
  BodyClearances::Scratch bodies;
  long instants = 0;
  std::stop_token stop = {};              ///< ends proofs; what is not decided then stays undecided
  std::array<Standing, 2> standing = {};  ///< by Index(Side)
};

}  // namespace halfstep
