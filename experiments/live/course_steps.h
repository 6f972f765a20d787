#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/live/course.h"
#include "planner/search/goal_region.h"
#include "planner/search/step_set.h"
#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

/// How a robot steps when it follows a course.
struct Gait {
  const StepSet& set;  ///< borrowed: a footstep is no farther from all of its elements than
  Pose2 cell;          ///< this, in x, y [m] and yaw [rad]
  double width = 0.0;  ///< between the soles' centres of feet that stand side by side [m] > 0
  double pace = 0.0;   ///< what a footstep takes, once its overlaps are found [s] > 0
  /// The height of the ground under a sole at X_WF for who stands at `from` [m]; NaN: none. Empty:
  /// it is level.
  std::function<double(const Pose2& X_WF, double from)> ground = {};
};

/// Where footsteps begin.
struct Standing {
  std::array<Foothold, 2> feet;     ///< soles in W by Index(Side)
  std::optional<Side> in_air = {};  ///< the foot that is to land first, wherever `feet` has it
  Side landed = Side::kRight;       ///< the foot that landed last, where none is in the air
};

/// What of a course comes next.
struct CourseSteps {
  std::vector<Footstep> footsteps;  ///< fewer than asked for where the ground does not bear one
  /// Nothing of the course is left when they are taken. Never of a velocity other than 0.
  bool complete = false;
  /// The least part of what the course asks of a footstep that the set has elements for; 1: all.
  double part = 1.0;
};

/// That footsteps fall short of their course, in words that follow others; "" where they do not.
std::string ShortfallText(const CourseSteps& steps);

/// Up to `count` footsteps along a course of velocity or path. With each of them the robot's middle
/// moves from beside the foot that supports by what the course asks for in `pace`, or by as much of
/// it as the set has elements for, in the same direction and curvature. Sideways and in yaw the
/// foot on that side moves, and the other one closes. Where the course rests, and at the end of a
/// path, the feet come to stand side by side. Precondition: the course is no list of footsteps.
CourseSteps FootstepsAlong(const Course& course, const Gait& gait, const Standing& standing,
                           int count);

/// A region around where the robot's middle shall be `ahead` [s] later, for a search around what is
/// in the way. Precondition: the course does not rest, and is no list of footsteps.
GoalRegion RegionAlong(const Course& course, const std::array<Foothold, 2>& feet, double ahead);

}  // namespace halfstep
