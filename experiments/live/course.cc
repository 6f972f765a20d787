#include "experiments/live/course.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "wpg/elementary.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {

std::string Course::Text() const {
  if (Rests()) return "come to rest";
  if (kind == CourseKind::kVelocity) {
    return Formatted("walk at %.6g m/s ahead, %.6g m/s to the left, %.6g rad/s", velocity[0],
                     velocity[1], velocity[2]);
  }
  if (kind == CourseKind::kPath) {
    return Formatted("follow a path of %zu points, %.6g m long, at %.6g m/s", path.size(),
                     PathLine(path).length(), speed);
  }
  return Formatted("take %zu %s, the %s foot first", footsteps.size(),
                   footsteps.size() == 1 ? "footstep" : "footsteps",
                   std::string(Name(footsteps.front().side)).c_str());
}

std::string Course::NameOf(int footstep) const {
  const Side side = Nth(footsteps, footstep).side;
  return Formatted("footstep %d (%s): ", footstep + 1, std::string(Name(side)).c_str());
}

bool SameCourse(const std::shared_ptr<const Course>& a, const std::shared_ptr<const Course>& b) {
  if (!a || !b) return !a && !b;
  if (a->kind != b->kind) return false;
  // What is said again, as by a person who holds a key down, changes nothing.
  if (a->kind == CourseKind::kVelocity) return a->velocity == b->velocity;
  return a->number == b->number;
}

Course Moved(const Pose2& X_WU, Course course) {
  for (Eigen::Vector2d& point : course.path) point = X_WU * point;
  for (CommandedFootstep& one : course.footsteps) one.X_WF = X_WU * one.X_WF;
  return course;
}

PathLine::PathLine(const std::vector<Eigen::Vector2d>& points) : points_(points), ends_{0.0} {
  for (size_t i = 1; i < points.size(); ++i) {
    ends_.push_back(ends_.back() + (points[i] - points[i - 1]).norm());
  }
}

PathPlace PathLine::On(size_t segment, double along) const {
  const Eigen::Vector2d from = points_[segment], to = points_[segment + 1];
  const double length = ends_[segment + 1] - ends_[segment];
  const Eigen::Vector2d p = from + along / length * (to - from);
  return {ends_[segment] + along, {p.x(), p.y(), Atan2(to.y() - from.y(), to.x() - from.x())}};
}

PathPlace PathLine::At(double s) const {
  const double at = std::clamp(s, 0.0, length());
  const auto next = std::upper_bound(ends_.begin() + 1, ends_.end() - 1, at);
  const auto segment = static_cast<size_t>(next - ends_.begin()) - 1;
  return On(segment, at - ends_[segment]);
}

PathPlace PathLine::Nearest(const Pose2& X_WB) const {
  constexpr double kTurn = 0.2;  // [m/rad]
  PathPlace nearest;
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i + 1 < points_.size(); ++i) {
    const Eigen::Vector2d along = points_[i + 1] - points_[i];
    const double length = ends_[i + 1] - ends_[i];
    const double part =
        std::clamp((X_WB.position() - points_[i]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const PathPlace place = On(i, part * length);
    const double off = (X_WB.position() - place.X_WP.position()).norm();
    const double turn = std::remainder(place.X_WP.yaw - X_WB.yaw, 2.0 * std::numbers::pi);
    const double far = Hypot(off, kTurn * turn);
    if (far >= least) continue;
    least = far;
    nearest = place;
  }
  return nearest;
}

}  // namespace halfstep
