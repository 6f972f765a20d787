#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "experiments/live/course.h"
#include "wpg/files/fields.h"

namespace halfstep {

/// Something that happens in an episode.
struct ScriptEvent {
  double at = 0.0;  ///< [s]
  /// jump, carry, appear, vanish, goal, walk, follow, footsteps, forbid, lose
  std::string what;
  std::string obstacle;      ///< of jump, carry, appear, vanish
  std::vector<double> xyz;   ///< where it jumps or is carried to, origin of its frame in W [m]
  double turn = 0.0;         ///< about the world's z meanwhile [rad]
  double speed = 0.0;        ///< of being carried, or along the path [m/s]
  std::vector<double> goal;  ///< the goal's new place [m]
  int area = 1;              ///< of forbid: a no-step area of the scene, from 1
  double lasts = 0.0;        ///< of lose: how long no frame arrives [s]
  /// Of walk: forward, to the left [m/s] and of yaw [rad/s], in the robot's heading frame.
  std::vector<double> velocity{};
  Eigen::Matrix2Xd path{2, 0};                 ///< of follow: its points [m]
  std::vector<CommandedFootstep> footsteps{};  ///< of footsteps: in their order
};

/// Whether the event commands a course in place of the goal: walk, follow, footsteps.
bool Commands(const ScriptEvent& event);
/// Whether the points make a path: at least two, each at least 1 mm from the one before.
bool IsPath(const Eigen::Matrix2Xd& points);
/// The course of an event, as the command of this number. Precondition: Commands(event).
Course CourseOf(const ScriptEvent& event, int number);
/// Declares its keys. Those that few events have are there of such events only.
void DeclareFields(Fields& fields, ScriptEvent* event);

}  // namespace halfstep
