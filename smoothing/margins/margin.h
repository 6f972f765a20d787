#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "smoothing/margins/tube.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/enumerators.h"
#include "wpg/nth.h"

namespace halfstep {

/// The kinds of statements that a walk must satisfy, in the order of certificates and tables. Each
/// margin says how far inside its limit the walk is, in its natural unit; positive is inside. The
/// class of a family (margins/NAME_margin.cc) says how it is evaluated and proved.
enum class MarginFamily : int {
  kFloor,          ///< height of a sole above the floor while it moves horizontally [m]
  kFootSpeed,      ///< limit − speed of the swing sole's centre [m/s]
  kFootYawRate,    ///< limit − |yaw rate| of the swing sole [rad/s]
  kZmp,            ///< distance of the ZMP inside the support polygon [m]
  kReach,          ///< stretched leg length − hip–ankle distance [m]
  kJoint,          ///< distance to the nearest joint limit [rad]
  kJointSpeed,     ///< joint speed limit − |q̇| [rad/s]
  kSelfClearance,  ///< distance between the robot's own bodies [m]
  kClearance,      ///< distance from the robot to the obstacles [m]
  kGround,         ///< height of a body's lowest point above the floor [m]; a foot may touch it
  kNoStep,         ///< distance of a standing sole's outline from the no-step areas [m]
  kZmpRobot,       ///< distance of the whole robot's ZMP inside the support polygon [m]
  kTorque,         ///< torque limit − |torque| of a leg joint [N m]
  kFriction,       ///< friction coefficient of the floor less what the soles need [1]
  /// limit that the robot file states − |q̈| of a leg joint [rad/s²]
  kJointAcceleration,
  kDoubleSupport,  ///< how long a half-step's ZMP goes from foot to foot [s]
  kLandingSpeed,   ///< limit − how fast the swing sole sinks near the floor [m/s]
  kFoothold,       ///< distance of a standing sole's outline inside its level of the ground [m]
  kOwn,            ///< what the program itself adds (own_margin.h), of its scale [1]
};
/// How many families there are.
inline constexpr int kNumMarginFamilies = NumEnumerators<MarginFamily>();

std::string_view Name(MarginFamily family);  ///< "zmp", "joint_speed" … as in YAML and CSV
std::string_view Unit(MarginFamily family);  ///< "m", "rad" …
/// What counts as a clear change of a margin [its unit]. It makes margins of different units
/// comparable.
double Scale(MarginFamily family);
/// What is demanded of each family unless the user says otherwise [its unit].
std::array<double, kNumMarginFamilies> DefaultDemands();
/// All families, in order. Of one robot: MarginEvaluator::families().
std::span<const MarginFamily> AllMarginFamilies();

class OwnStatement;
/// Margins of one's own (own_margin.h), which make up the family `own`.
using OwnMargins = std::vector<std::shared_ptr<const OwnStatement>>;
/// The families of a program with these margins of its own, in order: all, but kOwn only where
/// there is one.
std::span<const MarginFamily> FamiliesWith(const OwnMargins& own);

/// The margin of what has no limit [any unit].
inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();
/// What is demanded of a family of which nothing is demanded [any unit].
inline constexpr double kNotDemanded = -kUnlimited;

/// The value of one margin, and what it belongs to.
struct Margin {
  MarginFamily family = MarginFamily::kZmp;  ///< what it is a margin of
  double value = kUnlimited;                 ///< ≥ 0: within the limit [unit of the family]
  LocalTime at = {};                         ///< the same instant by half-step
  double t = 0.0;                            ///< absolute time in the walk where it was found [s]
  /// What the margin belongs to, −1: nothing in particular. Both ZMPs: the step in the air, or −1.
  /// Floor, foot speed, foot yaw rate, landing speed, no-step, foothold: Index(Side). Double
  /// support: the half-step. Reach, joints, joint speeds and accelerations, torques: 6·Index(Side)
  /// + joint. Clearances and ground: index of RobotModel::bodies.
  int subject = -1;
  /// Index of the obstacle or solid (clearance, floor; Scene::NameOf), second body
  /// (self-clearance), area (no-step) or solid of the ground (foothold).
  int other = -1;
  /// Not −1: found in the stop branch after this half-step; `at` and `t` are times of the branch.
  int stop_after = -1;
};

/// Limits of the quantities that the robot model does not bound, and what is demanded of each
/// margin.
struct MarginLimits {
  std::optional<double> foot_speed = 1.0;     ///< [m/s]; none: no limit
  std::optional<double> foot_yaw_rate = 2.0;  ///< [rad/s]
  std::optional<double> landing_speed = {};   ///< downwards, in the last centimetre [m/s]
  double joint_speed_scale = 1.0;             ///< of the robot's joint speed limits, ∈ (0, 1]
  /// Demanded margin δ by family, in its unit: feasible means margin ≥ δ. kNotDemanded where the
  /// family may be left out (FamilyTraits::may_be_none).
  std::array<double, kNumMarginFamilies> demanded = DefaultDemands();
  Tube tube = {};  ///< within which motions are to keep what is demanded
  /// What the tube adds to `demanded` for a robot (RaisedBy), set by Demandable; 0 without a tube.
  std::array<double, kNumMarginFamilies> raised = {};
  /// A clearance beyond this reads as this [m], or as twice the largest demanded clearance where
  /// that is more.
  double clearance_cap = 0.3;
  OwnMargins own = {};  ///< more margins to be kept, of one's own; not null

  /// What is demanded of the planned motion of a family [its unit], the tube's share included;
  /// kNotDemanded: nothing.
  double demanded_of(MarginFamily f) const { return Nth(demanded, f) + Nth(raised, f); }
  /// The same without the tube's share, to be set.
  double& demanded_of(MarginFamily f) { return Nth(demanded, f); }
  /// (value − demanded) / Scale: negative when infeasible; comparable between families. +∞ where
  /// nothing is demanded.
  double Slack(const Margin& margin) const {
    if (demanded_of(margin.family) == kNotDemanded) return kUnlimited;
    return (margin.value - demanded_of(margin.family)) / Scale(margin.family);
  }
};

/// One margin of each family.
using MarginSet = std::array<Margin, kNumMarginFamilies>;

}  // namespace halfstep
