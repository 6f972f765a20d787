#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "wpg/geometry/pose2.h"
#include "wpg/geometry/side.h"

namespace halfstep {

/// A footstep that somebody outside asks for.
struct CommandedFootstep {
  Side side = Side::kLeft;  ///< the foot that is to stand there
  Pose2 X_WF;               ///< where, seen from above, in W
  friend bool operator==(const CommandedFootstep&, const CommandedFootstep&) = default;
};

/// What a command asks for.
enum class CourseKind {
  kVelocity,   ///< to walk on at a velocity; to rest, where it is zero
  kPath,       ///< to walk along a polyline, and to rest at its end
  kFootsteps,  ///< to take these footsteps, and to rest after the last
};

/// Where a walk shall go on, endlessly, in place of a goal: what was commanded last. A wish: the
/// robot does of it what half-steps allow and what is proved.
struct Course {
  CourseKind kind = CourseKind::kVelocity;  ///< which of the others count
  int number = 1;                           ///< of the command among all of the episode, from 1
  /// In the robot's heading frame: forward and to the left [m/s], and of its yaw [rad/s].
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector2d> path;         ///< at least two points, in W [m]
  double speed = 0.1;                        ///< along the path [m/s] > 0
  std::vector<CommandedFootstep> footsteps;  ///< at least one

  /// Whether it asks for nothing but rest.
  bool Rests() const { return kind == CourseKind::kVelocity && velocity.isZero(0.0); }
  /// "walk at 0.1 m/s ahead, 0 m/s to the left, 0.2 rad/s".
  std::string Text() const;
  /// "footstep 2 (right): ", of a list, by index from 0.
  std::string NameOf(int footstep) const;
};

/// Whether a walk that was planned for one serves the other; null is the goal.
bool SameCourse(const std::shared_ptr<const Course>& a, const std::shared_ptr<const Course>& b);

/// The same for the world as it is at X_WU: path and footsteps moved with it.
Course Moved(const Pose2& X_WU, Course course);

/// A place on a path.
struct PathPlace {
  double s = 0.0;  ///< how far along it [m]
  Pose2 X_WP;      ///< there, with its x axis along the path
};

/// A polyline, by the length along it. Borrows the points, which are at least two.
class PathLine {
 public:
  /// Precondition: points are apart from the ones before them.
  explicit PathLine(const std::vector<Eigen::Vector2d>& points);

  double length() const { return ends_.back(); }  ///< [m]
  /// At s [m], clamped to the path.
  PathPlace At(double s) const;
  /// The nearest to a pose. Where the path comes by more than once, its direction counts: a turn by
  /// 1 rad as much as 0.2 m.
  PathPlace Nearest(const Pose2& X_WB) const;

 private:
  PathPlace On(size_t segment, double along) const;

  const std::vector<Eigen::Vector2d>& points_;
  std::vector<double> ends_;  // s at each point
};

}  // namespace halfstep
