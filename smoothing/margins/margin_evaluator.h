#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "smoothing/margins/margin_statements.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/nth.h"

namespace halfstep {

/// Evaluates every margin of a walk, of one robot among the obstacles of one scene, at single
/// instants. What holds between instants is for FeasibilityTest to say. Const; scratch is the
/// caller's.
class MarginEvaluator {
 public:
  /// What families remember. Use one for each thread.
  using Scratch = MarginScratch;

  /// `robot` and `scene` are copied. Where the robot's masses are not known, limits() demands
  /// nothing of its ZMP, nor of what its files do not limit. A tube needs one level (logic_error).
  MarginEvaluator(RobotModel robot, Scene scene, MarginLimits limits);

  /// The same robot, scene and margins of one's own, shared, with other limits.
  MarginEvaluator WithLimits(const MarginLimits& limits) const;

  const RobotModel& robot() const { return place().robot; }    ///< as given
  const Scene& scene() const { return place().scene; }         ///< as given
  const MarginPlace& place() const { return shared_->place; }  ///< robot and scene, prepared
  const MarginLimits& limits() const { return limits_; }       ///< limits and demanded margins
  const BodyClearances& clearances() const { return place().clearances; }  ///< distances of bodies
  /// Heights of bodies above the floor.
  const BodyHeights& heights() const { return place().heights; }
  /// For evaluations by one thread.
  Scratch MakeScratch() const { return {.bodies = clearances().MakeScratch()}; }
  /// The families that there are for this robot and these limits, in order.
  std::span<const MarginFamily> families() const { return families_; }
  /// The same, those that need little work first.
  std::span<const MarginFamily> families_by_cost() const { return by_cost_; }
  /// All statements of a family.
  const MarginStatements& statements(MarginFamily family) const {
    return *Nth(shared_->statements, family);
  }

  /// All margins at an instant. When a leg does not reach, those of joints, joint speeds, ground,
  /// clearance and self-clearance are −∞.
  MarginSet At(const SuperposedWalk& walk, const LocalTime& at, Scratch* scratch) const;

  /// The first margin that is found below what is demanded, families with little work first; none
  /// when all are kept. Clearances are only compared with what is demanded, so this is much cheaper
  /// than At.
  std::optional<Margin> FirstViolation(const SuperposedWalk& walk, const LocalTime& at,
                                       Scratch* scratch) const;

  /// Every margin below what is demanded, each pair of bodies and each body for itself, else the
  /// least of its family. Of what is −∞ because a leg does not reach, only the first is told, and
  /// none where the family `reach` says it.
  std::vector<Margin> Violations(const SuperposedWalk& walk, const LocalTime& at,
                                 Scratch* scratch) const;

  /// "clearance of RLEG_LINK5 - bar 0.0032 m (demanded 0.005) at half-step 3, tau = 0.412 s".
  std::string Describe(const Margin& margin) const;
  /// What a margin belongs to: "RLEG_LINK5 - bar", "right foot", "LLEG_JOINT3".
  std::string Subject(const Margin& margin) const {
    return statements(margin.family).Subject(margin);
  }

 private:
  struct Shared {
    Shared(RobotModel robot, Scene scene, OwnMargins own);
    MarginPlace place;
    // By family; borrow place.
    std::array<std::unique_ptr<const MarginStatements>, kNumMarginFamilies> statements;
  };
  void SetLimits(const MarginLimits& limits);

  std::shared_ptr<const Shared> shared_;
  MarginLimits limits_;
  std::vector<MarginFamily> families_, by_cost_;  // that are present
};

}  // namespace halfstep
