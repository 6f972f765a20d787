#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "smoothing/margins/margin_statements.h"
#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

/// Every margin of a walk of one robot among one scene's obstacles, at single instants. What holds
/// between instants is for others to say (FeasibilityTest). Const; scratch is the caller's.
class MarginEvaluator {
 public:
  /// What families remember; one for each thread.
  using Scratch = MarginScratch;

  /// `robot` and `scene` are copied.
  MarginEvaluator(RobotModel robot, Scene scene, MarginLimits limits);

  /// The same robot and scene, shared, with other limits.
  MarginEvaluator WithLimits(const MarginLimits& limits) const;

  const RobotModel& robot() const { return place().robot; }
  const Scene& scene() const { return place().scene; }
  const MarginPlace& place() const { return shared_->place; }
  const MarginLimits& limits() const { return limits_; }
  const BodyClearances& clearances() const { return place().clearances; }
  const BodyHeights& heights() const { return place().heights; }
  Scratch MakeScratch() const { return {.bodies = clearances().MakeScratch()}; }
  const MarginStatements& statements(MarginFamily family) const {
    return *shared_->statements[static_cast<size_t>(family)];
  }

  /// All margins at an instant. When a leg does not reach, joint, ground and clearance margins are
  /// −∞.
  MarginSet At(const SuperposedWalk& walk, const LocalTime& at, Scratch* scratch) const;

  /// The first margin found below what is demanded, cheapest families first; none: all are met.
  /// Clearances are only compared with what is demanded, so this is much cheaper than At.
  std::optional<Margin> FirstViolation(const SuperposedWalk& walk, const LocalTime& at,
                                       Scratch* scratch) const;

  /// "clearance of right foot (RLEG_LINK5) to 'bar' 0.0032 m at half-step 3, τ = 0.412 s".
  std::string Describe(const Margin& margin) const;
  /// What a margin belongs to: "RLEG_LINK5 – bar", "right foot", "LLEG_JOINT3".
  std::string Subject(const Margin& margin) const {
    return statements(margin.family).Subject(margin);
  }

 private:
  struct Shared {
    Shared(RobotModel robot, Scene scene);
    MarginPlace place;
    // By family; borrow place.
    std::array<std::unique_ptr<const MarginStatements>, kNumMarginFamilies> statements;
  };

  std::shared_ptr<const Shared> shared_;
  MarginLimits limits_;
};

}  // namespace halfstep
