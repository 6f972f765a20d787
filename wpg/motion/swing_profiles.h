#pragma once

#include <memory>

#include "wpg/motion/half_step_shape.h"
#include "wpg/motion/profile.h"
#include "wpg/motion/ramped_step.h"
#include "wpg/motion/smoothstep.h"

namespace halfstep {

/// The swing foot's horizontal motion in units of T: inside its flight, away from the floor by
/// foot_delay. Source: wpg/README.md, "Half-step".
RampedStep FootWindow(HalfStepKind kind, const HalfStepShape& shape);
/// Its motion up or down: the part of the flight next to the floor.
Smoothstep LiftWindow(HalfStepKind kind, const HalfStepShape& shape);
/// The waist's motion up or down, where there is one.
Smoothstep RiseWindow(HalfStepKind kind, const HalfStepShape& shape);

// Profiles of what is not the model's, for a half-step of duration T [s].
/// Of x, y and yaw of the swing foot. Precondition: foot_delay and foot_ramp in their ranges
/// (std::logic_error).
std::shared_ptr<const Profile> FootProfile(HalfStepKind kind, const HalfStepShape& shape,
                                           double duration);
/// Of its height. Precondition: lift_share in its range (std::logic_error).
std::shared_ptr<const Profile> LiftProfile(HalfStepKind kind, const HalfStepShape& shape,
                                           double duration);
/// Of the waist's height. Precondition: rise_begin and rise_end in their ranges (std::logic_error).
std::shared_ptr<const Profile> RiseProfile(HalfStepKind kind, const HalfStepShape& shape,
                                           double duration);
/// Of the waist's yaw.
std::shared_ptr<const Profile> WaistYawProfile(double duration);

}  // namespace halfstep
