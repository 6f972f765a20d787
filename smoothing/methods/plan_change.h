#pragma once

#include <Eigen/Core>
#include <optional>

#include "smoothing/proof/feasibility_test.h"
#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

/// How a plan goes another way than planned; what is not said stays as it is.
struct PlanChange {
  /// From 0; none: every step that has no duration or height of its own.
  std::optional<int> step = std::nullopt;
  std::optional<double> duration = std::nullopt;          ///< T of both half-steps [s]
  std::optional<double> via_height = std::nullopt;        ///< [m]
  std::optional<double> crouch = std::nullopt;            ///< of all half-steps [m]
  std::optional<Eigen::Vector2d> landing = std::nullopt;  ///< of the step, in W [m]
  double farther = 0.0;  ///< so much of the foot's way is the landing off, but for rounding [m]
};

/// Where changes are looked for.
struct ChangeRange {
  double most_duration = 6.0;                     ///< [s]
  double least_height = 0.01, most_height = 1.0;  ///< of the via point [m]

  /// Whether duration and height of a change lie within.
  bool Contains(const PlanChange& change) const {
    const double height = change.via_height.value_or(least_height);
    return change.duration.value_or(0.0) <= most_duration && height >= least_height &&
           height <= most_height;
  }
};

/// Whether the planned motion is feasible, of a plan or of steps of it by themselves (PlannedPart):
/// nothing overlaps there, so unless an obstacle moves they are feasible as in the plan.
Feasibility CheckPlanned(const HalfStepSequence& plan, const FeasibilityTest& test,
                         MarginEvaluator::Scratch* scratch);

}  // namespace halfstep
