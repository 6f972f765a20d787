#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <vector>

#include "experiments/config/planning_config.h"
#include "experiments/live/course.h"
#include "experiments/live/live_config.h"
#include "planner/scene/scene.h"
#include "wpg/geometry/pose2.h"

namespace halfstep {

/// What truly happens in an episode, known to no part of the robot: where every obstacle is at the
/// time t of the walk [s], by the script. Frame: that of the walk, in which the world drifts when
/// the robot does.
class TrueWorld {
 public:
  /// `scene`: with the spare boxes. Throws InputError when the script names an obstacle or an area
  /// that the scene does not have.
  TrueWorld(const Scene& scene, const GoalConfig& goal, const LiveOptions& options);

  /// One more event, at the time `event.at` of the walk [s], after those of the script that happen
  /// at the same time. Precondition: the scene has its obstacle.
  void Append(ScriptEvent event);
  /// Everything that happens, in times of the script, in their order.
  std::vector<ScriptEvent> Script() const;

  /// The same, for a walk that begins at the time `origin` of the script [s].
  TrueWorld Since(double origin) const;

  /// The same, as a robot sees it that strays in another way than `live.drift_m_s` says: X_WU is
  /// the pose of the world in the frame of the walk at the time t of the walk [s]. Obstacles and
  /// the goal's place move with it. The goal's yaw and no-step areas do not.
  TrueWorld SeenFrom(std::function<Pose2(double t)> X_WU) const;

  /// X_WU: where the world is in the frame of the walk at the time t of the walk [s].
  Pose2 WorldAt(double t) const;

  const Scene& scene() const { return scene_; }  ///< as its file says it

  /// Whether the obstacle of that index in scene() is in the world at time t [s].
  bool IsThere(size_t obstacle, double t) const;
  /// X_WO of that obstacle at time t [s].
  Eigen::Isometry3d PoseAt(size_t obstacle, double t) const;
  /// A speed that the obstacle does not exceed but where it jumps [m/s].
  double SpeedOf(size_t obstacle) const;
  /// Whether the no-step area of that index is there at time t [s].
  bool AreaIsThere(size_t area, double t) const;
  GoalRegion GoalAt(double t) const;  ///< where the robot shall go, as of time t [s]
  /// What was commanded in its place, as of time t [s]; null: nothing since the goal was set.
  std::shared_ptr<const Course> CourseAt(double t) const;
  /// Whether frames arrive at all.
  bool IsSeen(double t) const;
  /// The first time [s] from which on nothing happens any more, but for the drift.
  double end() const { return end_ - origin_; }

 private:
  size_t IndexOf(const std::string& obstacle) const;
  // Takes an event of an obstacle in; all that happen earlier are.
  void TakeIn(size_t obstacle, const ScriptEvent& event);

  Scene scene_;
  GoalRegion goal_;  // where it is at the beginning
  std::vector<ScriptEvent> script_;
  std::vector<std::vector<ScriptEvent>> of_obstacle_;
  size_t own_ = 0;       // obstacles that are no spare boxes
  double origin_ = 0.0;  // of the walk's time, in that of the script
  double drift_ = 0.0;
  std::function<Pose2(double)> seen_from_;  // none: by drift_
  double end_ = 0.0;
};

}  // namespace halfstep
