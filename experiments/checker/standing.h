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

/// By link: what moves all that hangs on it, itself included. Those of the last intervals are
/// remembered, for statements are looked at one after the other.
class Pushes {
 public:
  /// Borrows the motion. Moments are about `reference`, in W [m].
  explicit Pushes(RobotMotion* motion, Eigen::Vector3d reference = {0, 0, 0})
      : motion_(*motion), reference_(std::move(reference)) {}

  /// Precondition: no knot lies between both. Throws as RobotMotion::On.
  const std::vector<Push>& On(double from, double to);
  const Eigen::Vector3d& reference() const { return reference_; }  ///< [m]

  /// A lower bound of `margin` at every instant of an interval, and what it is in the middle; −∞
  /// across knots, and where it throws NotDefined.
  template <typename Margin>
  Part Look(double from, double to, const Margin& margin) const {
    Part part{.from = from, .to = to, .bound = -kInfinity, .value = -kInfinity};
    const auto look = [&](double a, double b) {
      try {
        return margin(a, b);
      } catch (const NotDefined&) {
        return -kInfinity;
      }
    };
    part.value = look(part.middle(), part.middle());
    if (!motion_.Pieces().HasKnot(from, to)) part.bound = look(from, to);
    return part;
  }

 private:
  RobotMotion& motion_;
  Eigen::Vector3d reference_;
  std::map<std::pair<double, double>, std::vector<Push>> known_;
};

}  // namespace halfstep::checker
