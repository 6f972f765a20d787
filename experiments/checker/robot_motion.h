#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "experiments/checker/curves.h"
#include "experiments/checker/interval_proof.h"
#include "experiments/checker/jointed_robot.h"

namespace halfstep::checker {

/// A robot's links along a trajectory: at an instant, and as functions of time. Joints that the
/// trajectory does not tell stay at 0.
class RobotMotion {
 public:
  /// Borrows the robot. Throws std::logic_error for joints that it has not.
  RobotMotion(const Trajectory& trajectory, const JointedRobot& robot);

  const JointedRobot& robot() const { return robot_; }  ///< that moves
  const Curves& curves() const { return curves_; }      ///< of its joints
  bool has_base() const { return base_ >= 0; }          ///< whether its root moves
  /// Index of a joint's curve; −1: it stays at 0.
  int CurveOf(int joint) const { return curve_of_[static_cast<size_t>(joint)]; }
  /// All of the trajectory, cut at its knots.
  Span Pieces() const { return {curves_.begin(), curves_.end(), &curves_.times()}; }

  /// Frames of all links in W at an instant: bounds, and about.
  struct Frames {
    std::vector<Frame> sure;               ///< hold the frames
    std::vector<Eigen::Isometry3d> about;  ///< their middles
  };
  /// The last instants are remembered, for pairs of bodies halve time at the same ones.
  const Frames& At(double t);

  /// What moves a body as seen from a link, or from W (−1).
  std::vector<JointedRobot::Lever> Levers(const JointedRobot::Body& body, int link) const;
  /// No point moves farther within [from, to] from where it is at t [m], by its levers.
  double Moved(const std::vector<JointedRobot::Lever>& levers, double from, double to,
               double t) const;

  /// A link's frame on [from, to]. Precondition: no knot lies between both. Throws NotDefined where
  /// the base turns too far for that. The last ones are remembered.
  const FrameIn<Curve>& On(int link, double from, double to);

 private:
  // No point at a distance r from the root's origin is farther than first + r·second from where it
  // is at t.
  std::pair<double, double> BaseMoved(double from, double to, double t) const;

  Curves curves_;
  const JointedRobot& robot_;
  std::vector<int> curve_of_;
  std::vector<double> slides_;  // by joint: no farther from 0, of those that slide [m]
  int base_ = -1;               // curve of its x
  std::map<double, Frames> frames_;
  std::map<std::pair<double, double>, std::vector<std::optional<FrameIn<Curve>>>> on_;
};

/// Where a frame's middle is, as doubles.
Eigen::Isometry3d MiddleOf(const Frame& X);
/// What a frame is on all of its interval, or in the middle of it.
Frame FrameOver(const FrameIn<Curve>& X, bool in_middle = false);

}  // namespace halfstep::checker
