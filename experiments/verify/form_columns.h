#pragma once

#include <array>

#include "wpg/motion/half_step_sequence.h"

namespace halfstep::verify {

/// The columns of half_steps.csv that are there when half-steps have forms of their own, or
/// footsteps are moved.
struct FormColumns {
  double via_lateral = 0;                                ///< [m]
  double foot_ramp = 0, foot_delay = 0, lift_share = 0;  ///< as HalfStepShape has them
  double via_along = 0;                                  ///< [m]
  double zmp_shift = 0, zmp_bump_ramp = 0;               ///< shift and bump_ramp of HalfStepShape
  Pose2 footstep = {};  ///< the step's, seen from where it is planned; as planned without columns
};

/// What verify knows by itself of a column of forms: a row for each but the footsteps'.
struct FormColumn {
  const char* name;              ///< in smoothing.fixed
  const char* key;               ///< in configs, of the flag that lets methods move it
  const char* column;            ///< in half_steps.csv
  double FormColumns::*value;    ///< where it is kept
  double HalfStep::*number;      ///< what it is of a half-step, or else
  double HalfStepShape::*shape;  ///< of its shape
  double least, most;            ///< what makes sense
  const char *before, *after;    ///< words around a value that does not
  const char* differs;           ///< what a step's half-steps must not have; null: each has its own

  /// Where it stands in a half-step.
  double& in(HalfStep* half_step) const {
    return number != nullptr ? half_step->*number : half_step->shape.*shape;
  }
  /// Whether both half-steps of a step share it.
  bool of_step() const { return differs != nullptr; }
};

/// In the order of the columns.
const std::array<FormColumn, 7>& AllFormColumns();

/// The form of a half-step as it is planned.
FormColumns PlannedForm(const HalfStep& planned);

}  // namespace halfstep::verify
