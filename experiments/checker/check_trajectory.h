#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/checker/jointed_robot.h"
#include "experiments/checker/trajectory.h"
#include "planner/scene/scene.h"

namespace halfstep::checker {

/// What is asked of a trajectory.
struct TrajectoryDemands {
  double self_clearance = 0.0;              ///< between bodies of the robot [m] ≥ 0
  double clearance = 0.0;                   ///< from obstacles [m] ≥ 0
  std::optional<double> acceleration = {};  ///< of every joint, at most [rad/s²]; none: not asked
  std::optional<double> ground = {};        ///< no body lower below z = 0 than this [m] ≥ 0
  /// A link that is said to stand still.
  struct Contact {
    std::string link;                 ///< its name
    std::optional<double> from = {};  ///< [s]; none: from the first knot on
    std::optional<double> to = {};    ///< [s]; none: to the last one
  };
  std::vector<Contact> contacts = {};  ///< that are claimed
  /// How far a corner of the box around a link's bodies is at most from where it is at `from` [m].
  double contact_distance = 1e-3;
  double contact_angle = 0.01;  ///< by how much it is turned at most from there [rad]
  /// The ZMP is inside of the soles that are claimed to stand by at least that [m] ≥ 0; none: not
  /// asked. A sole is the hull of those points of a link's bodies that are within contact_distance
  /// of its lowest one when its claim begins, where they are then; all in the plane of the lowest.
  std::optional<double> zmp = {};
  /// This coefficient of friction suffices there, with ‖f_t‖ and the twist about the vertical;
  /// none: not asked.
  std::optional<double> friction = {};
  /// Pairs of links of which nothing is asked, beside neighbours.
  std::vector<std::pair<std::string, std::string>> ignored = {};
};

/// A statement about one subject: for all t ∈ [0, end], or not.
struct TrajectoryFinding {
  /// What statements are about. Those from kContact to kLandingSpeed, and others, are of walks.
  enum class Kind {
    kLimits,
    kSpeed,
    kAcceleration,
    kSelfClearance,
    kClearance,
    kContact,
    kDoubleSupport,
    kFloor,
    kFootSpeed,
    kFootYawRate,
    kLandingSpeed,
    kZmp,
    kReach,
    kGround,
    kNoStep,
    kZmpRobot,
    kFriction,
    kTorque,
    kStill,
    kTilt,
    kFoothold
  };
  Kind kind = Kind::kLimits;  ///< what it is about
  std::string subject;        ///< "elbow", "forearm - shelf"
  bool proved = false;        ///< at least `demanded` is kept, for all t
  double demanded = 0.0;      ///< [rad, rad/s, rad/s², m]
  /// Proved: no less is kept at any time. Else about what is kept at `at`, to be looked at.
  double least = 0.0;
  double at = 0.0;  ///< where the least is kept, or was not proved [s]
  /// Of what is not proved: the least at the trajectory's own knots, as dense sampling at its rate
  /// would see it.
  std::optional<double> at_knots = {};
  /// Of a contact, the ground or friction that is not proved: the least limit that is, for all t
  /// [m, rad, 1].
  std::optional<double> holds = {};
  bool slides = false;        ///< it is about a joint that slides: in m, not rad
  bool hint_missing = false;  ///< not proved, for the proof tells no direction there
};

/// All findings, and what was not asked.
struct TrajectoryCheck {
  std::vector<TrajectoryFinding> findings;  ///< by kind, those that are not proved first
  std::vector<std::string> not_covered;     ///< sentences
  std::int64_t intervals = 0;               ///< of time that were looked at
  bool stopped = false;                     ///< before all was looked at: nothing is proved

  bool proved() const;  ///< all of it
  void Sort();          ///< findings as above
};

/// The solid of an obstacle, of a mesh its hull. Throws InputError for maps and hollow meshes.
ConvexBody BodyOfObstacle(const Obstacle& obstacle);

/// Looks at every statement, in interval arithmetic. On [m − h, m + h] a pair of bodies keeps at
/// least its gap along a direction at m less how far both may move (RobotMotion::Moved); where that
/// is not enough the interval is halved (Prove). Contacts, the ground and torques are looked at by
/// frames as functions of time (RobotMotion::On), forces by their second derivatives. `scene`: its
/// obstacles, at rest; a mesh counts as its convex hull. `progress(done)`, done ∈ [0, 1], says
/// whether to go on. Throws InputError for obstacles that move or are clouds, for links and times
/// of demands that are not there, and for ZMP and friction that cannot be known. Source:
/// experiments/check.md.
TrajectoryCheck CheckTrajectory(const Trajectory& trajectory, const JointedRobot& robot,
                                const Scene& scene, const TrajectoryDemands& demands,
                                const std::function<bool(double done)>& progress = {});

}  // namespace halfstep::checker
