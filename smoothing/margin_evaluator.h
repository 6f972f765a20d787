#pragma once

#include <memory>
#include <optional>
#include <string>

#include "planner/scene.h"
#include "smoothing/body_clearances.h"
#include "smoothing/margins.h"
#include "smoothing/superposed_walk.h"
#include "wpg/posture.h"
#include "wpg/robot_model.h"

namespace halfstep {

/// Every margin of a walk of one robot among one scene's obstacles, at single instants. What holds
/// between instants is for others to say (FeasibilityTest). Const; scratch is the caller's.
class MarginEvaluator {
 public:
  /// What the clearances remember, and how many instants were evaluated. One for each thread.
  struct Scratch {
    BodyClearances::Scratch bodies;
    long instants = 0;
  };

  /// `robot` and `scene` are copied.
  MarginEvaluator(RobotModel robot, Scene scene, MarginLimits limits);

  /// The same robot and scene, shared, with other limits.
  MarginEvaluator WithLimits(const MarginLimits& limits) const;

  const RobotModel& robot() const { return place_->robot; }
  const Scene& scene() const { return place_->scene; }
  const MarginLimits& limits() const { return limits_; }
  const BodyClearances& clearances() const { return place_->clearances; }
  Scratch MakeScratch() const { return {clearances().MakeScratch()}; }

  /// All margins at an instant. When a leg does not reach, joint and clearance margins are −∞.
  MarginSet At(const SuperposedWalk& walk, const LocalTime& at, Scratch* scratch) const;

  /// The first margin found below what is demanded, cheapest families first; none: all are met.
  /// Clearances are only compared with what is demanded, so this is much cheaper than At.
  std::optional<Margin> FirstViolation(const SuperposedWalk& walk, const LocalTime& at,
                                       Scratch* scratch) const;

  /// "clearance of right foot (RLEG_LINK5) to 'bar' 0.0032 m at half-step 3, τ = 0.412 s".
  std::string Describe(const Margin& margin) const;
  /// What a margin belongs to: "RLEG_LINK5 – bar", "right foot", "LLEG_JOINT3".
  std::string Subject(const Margin& margin) const;

 private:
  void FootMargins(const SuperposedWalk& walk, const LocalTime& at, const WalkJet& jet,
                   MarginSet* margins) const;
  void ZmpMargin(const SuperposedWalk& walk, const LocalTime& at, const WalkJet& jet,
                 MarginSet* margins) const;
  void JointSpeedMargins(const WalkJet& jet, Posture* posture, MarginSet* margins) const;
  void JointMargins(const Posture& posture, MarginSet* margins) const;

  struct Place {
    Place(RobotModel robot, Scene scene);
    RobotModel robot;
    Scene scene;
    BodyClearances clearances;  // borrows robot
  };

  std::shared_ptr<const Place> place_;
  MarginLimits limits_;
};

}  // namespace halfstep
