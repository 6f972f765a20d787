#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "experiments/config/planning_config.h"
#include "experiments/live/live_config.h"
#include "planner/scene/scene.h"
#include "wpg/geometry/pose2.h"

namespace halfstep {

/// What truly happens in an episode, known to no part of the robot: where every obstacle is at the
/// time t of the walk [s], by the script. Frame: that of the walk, in which the world drifts when
/// the robot does.
class TrueWorld {
 public:
  /// Throws InputError when the script names an obstacle or an area that the scene does not have.
  TrueWorld(const Scene& scene, const GoalConfig& goal, const LiveOptions& options);

  /// The same, for a walk that begins at the time `origin` of the script [s].
  TrueWorld Since(double origin) const;

  /// The same, as a robot sees it that strays in another way than `live.drift_m_s` says: X_WU is
  /// the pose of the world in the frame of the walk at the time t of the walk [s]. Obstacles and
  /// the goal's place move with it. The goal's yaw and no-step areas do not.
  TrueWorld SeenFrom(std::function<Pose2(double t)> X_WU) const;

  const Scene& scene() const { return scene_; }  ///< as its file says it

  bool IsThere(size_t obstacle, double t) const;
  Eigen::Isometry3d PoseAt(size_t obstacle, double t) const;
  /// A speed that the obstacle does not exceed but where it jumps [m/s].
  double SpeedOf(size_t obstacle) const;
  bool AreaIsThere(size_t area, double t) const;
  GoalRegion GoalAt(double t) const;
  /// Whether frames arrive at all.
  bool IsSeen(double t) const;
  /// The first time [s] from which on nothing happens any more, but for the drift.
  double end() const { return end_ - origin_; }

 private:
  std::vector<ScriptEvent> EventsOf(size_t obstacle) const;
  // Where the world is in the frame of the walk.
  Pose2 WorldAt(double t) const;

  Scene scene_;
  GoalConfig goal_;
  std::vector<ScriptEvent> script_;
  std::vector<std::vector<ScriptEvent>> of_obstacle_;
  double origin_ = 0.0;  // of the walk's time, in that of the script
  double drift_ = 0.0;
  std::function<Pose2(double)> seen_from_;  // none: by drift_
  double end_ = 0.0;
};

}  // namespace halfstep
