#pragma once

#include <optional>

#include "wpg/files/fields.h"
#include "wpg/motion/half_step.h"

namespace halfstep {

/// The group `half_step`: what holds for every half-step whose footstep says nothing else.
struct HalfStepConfig {
  double duration = 2.0;                ///< T [s]
  double zmp_shift = 0.1;               ///< t2 − t1 at that T [s]; scales with the duration
  double via_height = 0.25;             ///< [m]
  double via_lateral = 0.24;            ///< [m]
  double foot_delay = 0.1;              ///< of T
  std::optional<double> zmp_bump_ramp;  ///< of the bump
  double foot_ramp = 0.5;               ///< of the foot's horizontal motion
  double lift_share = 1.0;              ///< of the foot's flight
  double support_point = 0.0;           ///< [m]
  double rise_begin = HalfStepShape().rise_begin;  ///< of T
  double rise_end = HalfStepShape().rise_end;      ///< of T
  double crouch = 0.0;                             ///< [m]
};

/// Fractions of T, as half-steps have them.
HalfStepShape ShapeOf(const HalfStepConfig& config);

/// The keys of `half_step`.
void DeclareHalfStep(Fields& fields, HalfStepConfig* config);

}  // namespace halfstep
