#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/checker/check_trajectory.h"
#include "experiments/checker/interval_proof.h"
#include "experiments/checker/robot_motion.h"
#include "experiments/checker/standing.h"

namespace halfstep::checker {

/// A margin that is at least `demanded` for all t of a span, or not.
struct Statement {
  TrajectoryFinding::Kind kind = TrajectoryFinding::Kind::kLimits;  ///< what it is about
  std::string subject = {};                                         ///< "forearm - shelf"
  double demanded = 0.0;                                            ///< [rad, m …]
  Span span = {};                                                   ///< of time
  std::function<Part(double from, double to)> look = {};            ///< bounds of it on an interval
  std::function<double(double t)> value = {};  ///< about what it is at an instant
  /// The margin is what is left of that limit: then the least limit that holds is told too.
  std::optional<double> most = {};
  bool slides = false;  ///< of a joint that slides
};

/// About a time in which the same contacts are claimed; kind, subject and demand are left open.
/// `margin`: a lower bound of it on an interval without knots; may throw NotDefined.
Statement ByPieces(const Standing& time, const RobotMotion& motion,
                   const std::function<double(double from, double to)>& margin);

/// Each adds what is asked; statements borrow the motion, `obstacles` and the scene. Sentences on
/// what is not looked at go to `check`.
/// Self clearance and clearance. `obstacles`: the scene's, as bodies. Throws InputError for links
/// of `ignored` that are not there.
void AddPairs(const TrajectoryDemands& demands, const Scene& scene,
              const std::vector<ConvexBody>& obstacles, RobotMotion* motion,
              std::vector<Statement>* statements);
/// How low each link reaches.
void AddGround(const TrajectoryDemands& demands, RobotMotion* motion,
               std::vector<Statement>* statements, TrajectoryCheck* check);
/// How far links that are said to stand move and turn. Throws InputError for links and times that
/// are not there.
void AddContacts(const TrajectoryDemands& demands, RobotMotion* motion,
                 std::vector<Statement>* statements, TrajectoryCheck* check);
/// Where the floor has to push under links that are said to stand, and by which friction. Throws
/// InputError where it is asked for and cannot be known at any time.
void AddFloor(const Trajectory& trajectory, const TrajectoryDemands& demands,
              const std::vector<Standing>& standing, RobotMotion* motion,
              std::vector<Statement>* statements, TrajectoryCheck* check);
/// What joints have to give, by the links' masses: where the root is fixed, or one link stands.
void AddTorques(const Trajectory& trajectory, const std::vector<Standing>& standing,
                RobotMotion* motion, std::vector<Statement>* statements, TrajectoryCheck* check);

}  // namespace halfstep::checker
