#pragma once

#include <vector>

#include "planner/search/step_set.h"

namespace halfstep {

/// What a planner minimizes: footsteps, T of the half-steps, or an estimate of the smoothed walk's
/// duration.
enum class CostKind { kSteps, kRawDuration, kSmoothedDuration };

/// What a plan costs: the sum over its footsteps of what their elements cost.
struct StepCost {
  CostKind kind = CostKind::kSteps;  ///< which of them
  /// kSmoothedDuration: an estimate, to be fitted to smoothed walks. A step takes `step_time` at
  /// least, and longer when its swing foot travels far or turns: `time_per_metre` times its way on
  /// the floor from place to via point to place, `time_per_radian` times its turns.
  double step_time = 0.89;        ///< [s] > 0
  double time_per_metre = 1.06;   ///< [s/m] ≥ 0
  double time_per_radian = 0.06;  ///< [s/rad] ≥ 0
  /// What an element that changes the waist's height costs of another one: so that plans change it
  /// no more often than they have to.
  static constexpr double kChangeOfHeight = 1.25;

  /// The cost of each element: 1, 2T [s] or the estimate [s]. An element's way is that of its down
  /// half-step and of the up half-step that follows it.
  std::vector<double> OfElements(const StepSet& set) const;
};

/// How far the elements of a set can lead: bounds that no sequence of them exceeds.
class StepReach {
 public:
  /// Bounds for the `elements` of the set that are used, at least one.
  StepReach(const StepSet& set, const std::vector<int>& elements, const std::vector<double>& costs);

  /// No n footsteps take the landing foot farther than this from the first support [m].
  double Distance(int n) const;
  /// A number of footsteps below which the landing foot is nearer than `distance` [m] and has
  /// turned less than `turn` [rad]. Not rounded up: ≤ the least integer.
  double Steps(double distance, double turn) const;
  double one() const { return one_; }                ///< longest displacement by one element [m]
  double least_cost() const { return least_cost_; }  ///< of an element

 private:
  double one_ = 0.0, pair_ = 0.0;  // longest displacement by one element, by two [m]
  double turn_ = 0.0;              // largest yaw of an element [rad]
  double least_cost_ = 0.0;
};

}  // namespace halfstep
