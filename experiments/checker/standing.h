#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "experiments/checker/check_trajectory.h"
#include "experiments/checker/push.h"
#include "experiments/checker/robot_motion.h"

namespace halfstep::checker {

/// A time in which the same contacts are claimed.
struct Standing {
  double from = 0.0;               ///< [s]
  double to = 0.0;                 ///< [s]
  std::vector<int> links = {};     ///< that stand, each once
  std::vector<double> since = {};  ///< of each one: where its first claim begins [s]

  /// "left_foot, right_foot from 0 to 1 s".
  std::string Text(const UrdfTree& urdf) const;
};
/// All of a trajectory. Precondition: contacts are of links and times that are there.
std::vector<Standing> StandingOf(const TrajectoryDemands& demands, const RobotMotion& motion);

/// Why links have no accelerations between knots; "": they have.
std::string NoAccelerations(const Trajectory& trajectory, const RobotMotion& motion);

/// What moves links. Those of the last intervals are remembered, for statements are looked at one
/// after the other.
class Pushes {
 public:
  /// Borrows the motion. Moments are about `reference`, in W [m].
  explicit Pushes(RobotMotion* motion, Eigen::Vector3d reference = {0, 0, 0})
      : motion_(*motion), reference_(std::move(reference)) {}

  /// Of a link and all that hangs on it; of the root: of all. Precondition: no knot lies between
  /// both. Throws as RobotMotion::On.
  const Push& Below(int link, double from, double to) { return On(from, to).below[Index(link)]; }
  /// Of all others.
  Push Others(int link, double from, double to);
  const Eigen::Vector3d& reference() const { return reference_; }  ///< [m]

 private:
  struct ByLink {
    std::vector<Push> own, below;
  };
  static size_t Index(int link) { return static_cast<size_t>(link); }
  const ByLink& On(double from, double to);

  RobotMotion& motion_;
  Eigen::Vector3d reference_;
  std::map<std::pair<double, double>, ByLink> known_;
};

}  // namespace halfstep::checker
