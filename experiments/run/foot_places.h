#pragma once

#include <optional>
#include <string>

#include "planner/scene/no_step_areas.h"
#include "planner/search/goal_region.h"
#include "smoothing/margins/margin_evaluator.h"
#include "wpg/motion/posture.h"

namespace halfstep {

/// What is in the way of a foot that stands somewhere, of what rests.
struct FootPlace {
  double clearance = 0.0;                    ///< of the foot's bodies to the nearest obstacle [m]
  std::optional<std::string> obstacle = {};  ///< its name; none: there is none within 0.3 m
  bool on_area = false;  ///< whether the sole is nearer to a no-step area than is demanded
  bool free = true;      ///< whether the place keeps what is demanded of both
};

/// Places of single feet among the obstacles of a scene that rest, whatever the rest of the robot
/// does. The foot's link is as in a walk: its sole flat on the floor. Const.
class FootPlaces {
 public:
  /// Robot, scene and demands are those of `evaluator`, which is borrowed.
  explicit FootPlaces(const MarginEvaluator& evaluator);

  const RobotModel& robot() const { return evaluator_.robot(); }      ///< of the evaluator
  const Scene& scene() const { return evaluator_.scene(); }           ///< of the evaluator
  const MarginLimits& limits() const { return evaluator_.limits(); }  ///< of the evaluator
  /// With the sole of `side` at X_WF.
  FootPlace At(Side side, const Foothold& X_WF) const;

 private:
  const MarginEvaluator& evaluator_;
  NoStepAreas areas_;
  Posture standing_;
};

/// Why a goal has no place for a sole, as a sentence, or "": of its places, taken on a grid with
/// several yaws, one is free. Where all are taken, none was proved to be.
std::string GoalWithoutPlace(const GoalRegion& goal, const FootPlaces& places);

}  // namespace halfstep
