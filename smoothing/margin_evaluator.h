#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "planner/no_step_areas.h"
#include "planner/scene.h"
#include "smoothing/body_clearances.h"
#include "smoothing/body_heights.h"
#include "smoothing/margins.h"
#include "smoothing/superposed_walk.h"
#include "wpg/posture.h"
#include "wpg/robot_model.h"

namespace halfstep {

/// Every margin of a walk of one robot among one scene's obstacles, at single instants. What holds
/// between instants is for others to say (FeasibilityTest). Const; scratch is the caller's.
class MarginEvaluator {
 public:
  /// What the clearances remember, the no-step area that was nearest to each sole where it stood
  /// last, and how many instants were evaluated. One for each thread.
  struct Scratch {
    struct Standing {
      Pose2 X_WF;
      NoStepAreas::Nearest nearest;
      bool known = false;
    };
    BodyClearances::Scratch bodies;
    long instants = 0;
    std::array<Standing, 2> standing = {};  ///< by Index(Side)
  };

  /// `robot` and `scene` are copied.
  MarginEvaluator(RobotModel robot, Scene scene, MarginLimits limits);

  /// The same robot and scene, shared, with other limits.
  MarginEvaluator WithLimits(const MarginLimits& limits) const;

  const RobotModel& robot() const { return place_->robot; }
  const Scene& scene() const { return place_->scene; }
  const MarginLimits& limits() const { return limits_; }
  const BodyClearances& clearances() const { return place_->clearances; }
  const BodyHeights& heights() const { return place_->heights; }
  const NoStepAreas& no_step_areas() const { return place_->areas; }
  Scratch MakeScratch() const { return {.bodies = clearances().MakeScratch()}; }

  /// All margins at an instant. When a leg does not reach, joint, ground and clearance margins are
  /// −∞.
  MarginSet At(const SuperposedWalk& walk, const LocalTime& at, Scratch* scratch) const;

  /// The first margin found below what is demanded, cheapest families first; none: all are met.
  /// Clearances are only compared with what is demanded, so this is much cheaper than At.
  std::optional<Margin> FirstViolation(const SuperposedWalk& walk, const LocalTime& at,
                                       Scratch* scratch) const;

  /// Distance of a sole from the no-step areas [m]: +∞ while it is in the air, or where there are
  /// none.
  Margin NoStep(const SuperposedWalk& walk, const LocalTime& at, const WalkVector& x, Side side,
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
  void NoStepMargins(const SuperposedWalk& walk, const LocalTime& at, const WalkVector& x,
                     Scratch* scratch, MarginSet* margins) const;
  void JointSpeedMargins(const WalkJet& jet, Posture* posture, MarginSet* margins) const;
  void JointMargins(const Posture& posture, MarginSet* margins) const;

  struct Place {
    Place(RobotModel robot, Scene scene);
    RobotModel robot;
    Scene scene;
    BodyClearances clearances;  // borrows robot
    BodyHeights heights;        // borrows robot
    NoStepAreas areas;
  };

  std::shared_ptr<const Place> place_;
  MarginLimits limits_;
};

}  // namespace halfstep
